#pragma once

#include "shared/error.h"

#include <functional>
#include <string>
#include <vector>

namespace spall {

/// The words after the program's name, sorted: one input file, options, overrides.
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

/// Set by SIGINT and SIGTERM; long loops look at it between steps, save and return ExitCode::interrupted.
bool interrupted();

/// Runs `body`, turns exceptions into one line on standard error and the exit codes of ExitCode.
/// @param speaks false for a process that leaves the words to another one
int run_program(const std::string& name, const std::function<ExitCode()>& body, bool speaks = true);

} // namespace spall
