#include "shared/program.h"

#include "shared/input/visible.h"

#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <stdexcept>

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

void print_error(const std::string& program, const std::string& message) {
  std::fprintf(stderr, "%s: %s\n", program.c_str(), shortened(visible(message)).c_str());
}

void print_sound(const std::string& input) { std::printf("%s: no fault was found\n", input.c_str()); }

void print_warnings(const std::string& program, const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) print_error(program, "warning: " + warning);
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
