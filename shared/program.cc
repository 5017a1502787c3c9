#include "shared/program.h"

#include "shared/nearest.h"

#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <exception>

namespace spall {
namespace {

volatile std::sig_atomic_t stop_requested = 0;

/// The first signal requests an orderly end, the second one ends the program at once.
void on_signal(int signal) {
  stop_requested = 1;
  std::signal(signal, SIG_DFL);
}

} // namespace

bool interrupted() { return stop_requested != 0; }

CommandLine parse_command_line(int argc, char** argv) {
  CommandLine line;
  const std::vector<std::string> words(argv + 1, argv + argc);
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    if (word == "--help" || word == "-h" || word.starts_with("--help=")) {
      line.help = true;
      if (word.starts_with("--help="))
        line.topic = word.substr(7);
      else if (i + 1 < words.size() && !words[i + 1].starts_with("-"))
        line.topic = words[++i];
    } else if (word == "--restart") {
      line.restart = true;
    } else if (word == "--force") {
      line.force = true;
    } else if (word == "--plan") {
      line.plan = true;
    } else if (word == "--accuracy" || word.starts_with("--accuracy=")) {
      std::string percent = word.size() > 10 ? word.substr(11) : ++i < words.size() ? words[i] : "";
      if (percent.ends_with("%")) percent.pop_back();
      if (percent.empty()) throw InputError("command line: --accuracy needs a percentage after it");
      line.overrides.push_back("Run/Accuracy=" + percent);
    } else if (word == "--version") {
      line.version = true;
    } else if (word == "--output" || word == "-o" || word.starts_with("--output=")) {
      const bool joined = word.starts_with("--output=");
      line.output = joined ? word.substr(9) : ++i < words.size() ? words[i] : "";
      if (line.output.empty()) throw InputError("command line: " + word + " needs a name after it");
    } else if (word.starts_with("-")) {
      static const std::vector<std::string> options = {"--help", "--version", "--restart", "--force",
                                                       "--plan", "--output",  "--accuracy"};
      throw InputError("command line: unknown option '" + word + "'" + did_you_mean(word, options) +
                       ", see --help");
    } else if (word.find('=') != std::string::npos) {
      line.overrides.push_back(word);
    } else if (line.input.empty()) {
      line.input = word;
    } else {
      line.more.push_back(word);
    }
  }
  if (line.restart && line.force)
    throw InputError(
        "command line: --restart goes on with the results that are there, --force replaces them: "
        "give one of the two");
  return line;
}

void print_warnings(const std::string& program, const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings)
    std::fprintf(stderr, "%s: warning: %s\n", program.c_str(), warning.c_str());
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
  std::signal(SIGPIPE, SIG_IGN); // a reader of the words that goes away must not end the computation
  std::signal(SIGXFSZ, SIG_IGN); // beyond the limit on file sizes a write fails like one to a full disk
  const auto fail = [&](const char* what, ExitCode code) {
    std::fflush(stdout);
    if (speaks) std::fprintf(stderr, "%s: %s\n", name.c_str(), what);
    return static_cast<int>(code);
  };
  int code = 0;
  try {
    code = static_cast<int>(body());
  } catch (const InputError& error) {
    code = fail(error.what(), ExitCode::bad_input);
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
