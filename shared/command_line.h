#pragma once

#include <filesystem>
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

/// Folder for the results: --output, or out/NAME for an input NAME.prm.
std::filesystem::path output_folder(const CommandLine& line);

} // namespace spall
