#pragma once

#include "shared/error.h"

#include <functional>
#include <string>
#include <vector>

namespace spall {

/// The arguments of a program, sorted into input file, options and overrides.
struct CommandLine {
  std::string input;                  ///< CASE.prm or SCENE.prm
  std::vector<std::string> more;      ///< further positional arguments
  std::vector<std::string> overrides; ///< Section/Key=value
  std::string output = "out";         ///< --output DIR
  bool restart = false;               ///< --restart
  bool plan = false;                  ///< --plan
  bool help = false;                  ///< --help
};

/// @throws InputError for an unknown option, or a missing value.
CommandLine parse_command_line(int argc, char** argv);

/// True once SIGINT or SIGTERM has arrived. Long loops test it between steps, save and return
/// ExitCode::interrupted.
bool interrupted();

/// Runs `body` and returns its exit code; an exception becomes one line on standard error and the exit code
/// that belongs to it.
/// @param speaks false if another process prints the error message
int run_program(const std::string& name, const std::function<ExitCode()>& body, bool speaks = true);

} // namespace spall
