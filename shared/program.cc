#include "shared/program.h"

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
    if (word == "--help" || word == "-h") {
      line.help = true;
    } else if (word == "--restart") {
      line.restart = true;
    } else if (word == "--plan") {
      line.plan = true;
    } else if (word == "--output") {
      if (++i == words.size()) throw InputError("command line: --output needs a folder");
      line.output = words[i];
    } else if (word.starts_with("-")) {
      throw InputError("command line: unknown option '" + word + "', see --help");
    } else if (word.find('=') != std::string::npos) {
      line.overrides.push_back(word);
    } else if (line.input.empty()) {
      line.input = word;
    } else {
      line.more.push_back(word);
    }
  }
  return line;
}

int run_program(const std::string& name, const std::function<ExitCode()>& body, bool speaks) {
  std::setvbuf(stdout, nullptr, _IOLBF,
               0); // line buffering keeps the order of output and error messages in a log
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  std::signal(SIGXFSZ,
              SIG_IGN); // so that a write beyond the limit on file sizes fails like one to a full disk
  const auto fail = [&](const char* what, ExitCode code) {
    std::fflush(stdout);
    if (speaks) std::fprintf(stderr, "%s: %s\n", name.c_str(), what);
    return static_cast<int>(code);
  };
  try {
    return static_cast<int>(body());
  } catch (const InputError& error) {
    return fail(error.what(), ExitCode::bad_input);
  } catch (const std::exception& error) {
    return fail(error.what(), ExitCode::computation_failed);
  }
}

} // namespace spall
