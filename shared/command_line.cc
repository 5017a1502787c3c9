#include "shared/command_line.h"

#include "shared/error.h"
#include "shared/input/quantity.h"
#include "shared/input/text_file.h"
#include "shared/nearest.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace spall {
namespace {

[[noreturn]] void refuse(const std::string& why) { throw InputError("command line: " + why); }

/// @return the option of --accuracy as an override. @throws InputError
std::string accuracy_key(std::string percent) {
  if (percent.ends_with("%")) percent.pop_back();
  std::string unit;
  double number = 0;
  try {
    number = parse_number(percent, unit);
  } catch (const std::invalid_argument&) {
    unit = percent;
  }
  if (!unit.empty() || !(number > 0))
    refuse("--accuracy: found '" + percent + "', allowed: Run/Accuracy in percent, more than 0");
  return "Run/Accuracy=" + percent;
}

/// The options of a program, which write into a command line.
class OptionReader {
public:
  OptionReader(const Options& options, CommandLine& line) {
    app.set_help_flag(); // ours may have a topic
    app.allow_extras();  // files and overrides, in their order
    add_value("-h,--help", line.topic)->expected(0, 1);
    add_value("-o,--output", line.output)->type_name("DIR");
    add_flag("--version", line.version);
    add_flag("--check", line.check);
    if (options.restart) add_flag("--restart", line.restart);
    if (options.force) add_flag("--force", line.force);
    if (options.plan) add_flag("--plan", line.plan);
    if (options.accuracy) add_value("--accuracy", accuracy)->type_name("PERCENT");
  }

  /// @return the words that belong to no option. @throws InputError
  std::vector<std::string> read(std::vector<std::string> words) {
    std::reverse(words.begin(), words.end()); // the library takes the last one first
    try {
      app.parse(words);
    } catch (const CLI::ParseError& error) {
      refuse(std::string(error.what()) + ", see --help");
    }
    for (const CLI::Option* option : app.get_options()) check(*option);
    for (const std::string& word : app.remaining())
      if (word.starts_with("-"))
        refuse("unknown option '" + word + "'" + did_you_mean(word.substr(0, word.find('=')), names()) +
               ", see --help");
    return app.remaining();
  }

  bool given(const std::string& option) const { return app.count(option) > 0; }

  std::string accuracy;

private:
  void add_flag(const std::string& names, bool& set) { app.add_flag(names, set); }
  CLI::Option* add_value(const std::string& names, std::string& value) {
    return app.add_option(names, value)->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  }

  std::vector<std::string> names() const {
    std::vector<std::string> found;
    for (const CLI::Option* option : app.get_options()) found.push_back("--" + option->get_lnames().front());
    return found;
  }

  static void check(const CLI::Option& option) {
    const std::string name = option.get_name();
    if (name == "--help" || option.count() == 0) return;
    if (option.count() > 1) refuse("found " + name + " twice, allowed: once");
    const std::string& found = option.results().front();
    if (option.get_items_expected_max() == 0 && found != "true") // what the library has for a flag
      refuse("found '" + name + "=" + found + "', allowed: " + name + " without a value");
    if (found.empty() || found.starts_with("-") || found.starts_with("="))
      refuse(name + ": found '" + found + "', allowed: " + option.get_type_name() +
             " that begins with neither - nor =");
  }

  CLI::App app;
};

void check_together(const CommandLine& line) {
  if (line.restart && line.force)
    refuse("--restart goes on with the results that are there, --force replaces them: give one of the two");
  for (const auto& [given, option] : {std::pair(line.plan, "--plan"), {line.check, "--check"}})
    if (given && (line.restart || line.force))
      refuse(std::string(option) + " writes nothing, so it goes with neither --restart nor --force");
  if (line.plan && line.check) refuse("--plan makes the checks of --check too: give one of the two");
}

/// Puts a word that belongs to no option where it belongs.
void sort(const std::string& word, CommandLine& line) {
  if (word.empty()) refuse("found an empty word, allowed: the name of a file");
  const bool has_sign = word.find('=') != std::string::npos;
  if (has_sign && !fault_of_file(word).empty()) // a=b.prm may be a scene
    line.overrides.push_back(word);
  else if (line.input.empty())
    line.input = word;
  else
    line.more.push_back(word);
}

} // namespace

CommandLine parse_command_line(int argc, char** argv, const Options& options) {
  CommandLine line;
  OptionReader reader(options, line);
  for (const std::string& word : reader.read({argv + 1, argv + argc})) sort(word, line);
  line.help = reader.given("--help");
  if (options.accuracy && reader.given("--accuracy")) line.overrides.push_back(accuracy_key(reader.accuracy));
  check_together(line);
  return line;
}

std::filesystem::path output_folder(const CommandLine& line) {
  if (!line.output.empty()) return line.output;
  return std::filesystem::path("out") / std::filesystem::path(line.input).stem();
}

} // namespace spall
