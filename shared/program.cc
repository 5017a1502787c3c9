#include "shared/program.h"

#include "shared/input/quantity.h"
#include "shared/input/text_file.h"
#include "shared/input/visible.h"
#include "shared/input/words.h"
#include "shared/nearest.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <set>
#include <stdexcept>
#include <utility>

namespace spall {
namespace {

volatile std::sig_atomic_t stop_requested = 0, at_once_requested = 0;

/// The first signal requests an orderly end, the second one ends the program at once.
void on_signal(int signal) {
  if (at_once_requested) {
    static constexpr char words[] = "interrupted before anything was computed: nothing was written\n";
    if (write(STDERR_FILENO, words, sizeof words - 1) < 0)
      _exit(static_cast<int>(ExitCode::computation_failed));
    _exit(static_cast<int>(ExitCode::interrupted));
  }
  stop_requested = 1;
  std::signal(signal, SIG_DFL);
}

} // namespace

bool interrupted() { return stop_requested != 0; }

void end_at_once_if_interrupted(bool at_once) { at_once_requested = at_once; }

namespace {

/// Reads the words of a command line one after the other.
class WordReader {
public:
  WordReader(int argc, char** argv, const Options& options) : words(argv + 1, argv + argc) {
    names = {"--help", "--version", "--output", "--check"};
    for (const auto& [has, name] : {std::pair(options.restart, "--restart"),
                                    {options.force, "--force"},
                                    {options.plan, "--plan"},
                                    {options.accuracy, "--accuracy"}})
      if (has) names.emplace_back(name);
  }

  CommandLine read() {
    for (place = 0; place < words.size(); ++place) take(words[place]);
    check();
    return std::move(line);
  }

private:
  [[noreturn]] static void refuse(const std::string& why) { throw InputError("command line: " + why); }

  void take(const std::string& word) {
    const std::string option = word == "-o"   ? "--output"
                               : word == "-h" ? "--help"
                                              : word.substr(0, word.find('='));
    if (!word.starts_with("-"))
      take_plain(word);
    else if (!has(option))
      refuse("unknown option '" + word + "'" + did_you_mean(option, names) + ", see --help");
    else if (option == "--help")
      line.help = true, line.topic = topic(word);
    else if (!once(option))
      refuse("found " + option + " twice, allowed: once");
    else if (option == "--output")
      line.output = value(word, "a name");
    else if (option == "--accuracy")
      set_accuracy(value(word, "a percentage"));
    else
      flag(word, option);
  }

  bool has(const std::string& option) const {
    return std::find(names.begin(), names.end(), option) != names.end();
  }
  bool once(const std::string& option) { return seen.insert(option).second; }

  void flag(const std::string& word, const std::string& option) {
    if (word != option) refuse("found '" + word + "', allowed: " + option + " without a value");
    (option == "--restart" ? line.restart
     : option == "--force" ? line.force
     : option == "--plan"  ? line.plan
     : option == "--check" ? line.check
                           : line.version) = true;
  }

  /// What follows the option, behind a sign or as the next word.
  std::string value(const std::string& word, const std::string& what) {
    const std::size_t sign = word.find('=');
    const bool joined = sign != std::string::npos;
    const std::string found = joined ? word.substr(sign + 1) : ++place < words.size() ? words[place] : "";
    const std::string option = word.substr(0, sign);
    if (found.empty()) refuse(option + " needs " + what + " after it");
    if (!joined && found.starts_with("-"))
      refuse(option + " needs " + what + " after it, found '" + found + "'; " + option + "=" + found +
             " if it is meant");
    return found;
  }

  std::string topic(const std::string& word) {
    if (const std::size_t sign = word.find('='); sign != std::string::npos) return word.substr(sign + 1);
    const bool follows = place + 1 < words.size() && !words[place + 1].starts_with("-");
    return follows ? words[++place] : "";
  }

  void set_accuracy(std::string percent) {
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
    take_plain("Run/Accuracy=" + percent);
  }

  void take_plain(const std::string& word) {
    const std::size_t sign = word.find('=');
    const bool is_name = sign != std::string::npos && fault_of_file(word).empty(); // a=b.prm may be a scene
    if (sign != std::string::npos && !is_name) {
      line.overrides.push_back(word);
    } else if (word.empty()) {
      refuse("found an empty word, allowed: the name of a file");
    } else if (line.input.empty()) {
      line.input = word;
    } else {
      line.more.push_back(word);
    }
  }

  void check() const {
    if (line.restart && line.force)
      refuse("--restart goes on with the results that are there, --force replaces them: give one of the two");
    for (const auto& [given, option] : {std::pair(line.plan, "--plan"), {line.check, "--check"}})
      if (given && (line.restart || line.force))
        refuse(std::string(option) + " writes nothing, so it goes with neither --restart nor --force");
    if (line.plan && line.check) refuse("--plan makes the checks of --check too: give one of the two");
  }

  std::vector<std::string> words, names;
  std::size_t place = 0;
  std::set<std::string> seen; ///< options
  CommandLine line;
};

} // namespace

CommandLine parse_command_line(int argc, char** argv, const Options& options) {
  return WordReader(argc, argv, options).read();
}

void print_error(const std::string& program, const std::string& message) {
  std::fprintf(stderr, "%s: %s\n", program.c_str(), shortened(visible(message)).c_str());
}

void print_sound(const std::string& input) { std::printf("%s: no fault was found\n", input.c_str()); }

void print_warnings(const std::string& program, const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) print_error(program, "warning: " + warning);
}

std::filesystem::path output_folder(const CommandLine& line) {
  if (!line.output.empty()) return line.output;
  return std::filesystem::path("out") / std::filesystem::path(line.input).stem();
}

bool hold_standard_streams() {
  bool closed = false;
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(descriptor, F_GETFD) != -1) continue;
    open("/dev/null", O_RDWR); // takes the lowest number that is free: this one
    closed = closed || descriptor == STDOUT_FILENO;
  }
  return closed;
}

int run_program(const std::string& name, const std::function<ExitCode()>& body, bool speaks) {
  std::setvbuf(stdout, nullptr, _IOLBF,
               0); // line buffering keeps the order of output and error messages in a log
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  if (std::signal(SIGHUP, on_signal) == SIG_IGN) std::signal(SIGHUP, SIG_IGN); // nohup stays in force
  std::signal(SIGPIPE, SIG_IGN); // a reader of the words that goes away must not end the computation
  std::signal(SIGXFSZ, SIG_IGN); // beyond the limit on file sizes a write fails like one to a full disk
  const auto fail = [&](const char* what, ExitCode code) {
    std::fflush(stdout);
    if (speaks) print_error(name, what);
    return static_cast<int>(code);
  };
  int code = 0;
  end_at_once_if_interrupted(false);
  try {
    code = static_cast<int>(body());
  } catch (const InputError& error) {
    code = fail(error.what(), ExitCode::bad_input);
  } catch (const std::bad_alloc&) {
    code = fail("the memory of this machine, or what the program is allowed of it, is used up",
                ExitCode::computation_failed);
  } catch (const std::exception& error) {
    code = fail(error.what(), ExitCode::computation_failed);
  }
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    std::fprintf(stderr, "%s: standard output could not be written: words are missing there\n", name.c_str());
    std::clearerr(stdout);
    if (code == 0) code = static_cast<int>(ExitCode::computation_failed);
  }
  return code;
}

} // namespace spall
