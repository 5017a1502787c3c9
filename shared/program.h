#pragma once

#include "shared/error.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace spall {

/// The arguments of a program, sorted into input file, options and overrides.
struct CommandLine {
  std::string input;                  ///< CASE.prm or SCENE.prm
  std::vector<std::string> more;      ///< further positional arguments
  std::vector<std::string> overrides; ///< Section/Key=value; --accuracy P% is Run/Accuracy=P
  std::string output;                 ///< --output DIR, --output=DIR or -o DIR; empty: not given
  bool restart = false;               ///< --restart
  bool force = false;                 ///< --force
  bool plan = false;                  ///< --plan
  bool check = false;                 ///< --check
  bool help = false;                  ///< --help
  std::string topic;                  ///< --help SECTION or --help KEY; empty: everything
  bool version = false;               ///< --version
};

/// What a program does besides --output, --check, --help and --version.
struct Options {
  bool restart = false, force = false, plan = false, accuracy = false;
};

/// Of a key that is given twice the last word counts, so that scripts can add words to those of their users.
/// @throws InputError for an option that the program does not have, an option that is given twice, a missing
/// value, or options that contradict each other.
CommandLine parse_command_line(int argc, char** argv, const Options& options);

/// Prints one line on standard error that a terminal only shows (visible()).
void print_error(const std::string& program, const std::string& message);

/// Prints what --check says of an input that it has found no fault in.
void print_sound(const std::string& input);

/// Prints a line for each warning on standard error, with the name of the program before it.
void print_warnings(const std::string& program, const std::vector<std::string>& warnings);

/// Folder for the results: --output, or out/NAME for an input NAME.prm.
std::filesystem::path output_folder(const CommandLine& line);

/// Opens /dev/null in place of standard input, output and error where they are closed, so that no file that
/// the program opens takes their numbers and gets words. The first call of a program.
/// @return whether standard output was closed
bool hold_standard_streams();

/// True once SIGINT, SIGTERM or SIGHUP has arrived. Long loops test it between steps, save and return
/// ExitCode::interrupted.
bool interrupted();

/// Whether a signal ends the program at once, with a line and ExitCode::interrupted: as long as nothing has
/// been computed that could be saved, such as during the setup of a large model. Not so at first.
void end_at_once_if_interrupted(bool at_once);

/// Runs `body` and returns its exit code; an exception becomes one line on standard error and the exit code
/// that belongs to it. What was written to standard output must have arrived: otherwise a line says so, and
/// success becomes ExitCode::computation_failed.
/// @param speaks false if another process prints the line
int run_program(const std::string& name, const std::function<ExitCode()>& body, bool speaks = true);

} // namespace spall
