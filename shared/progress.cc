#include "shared/progress.h"

#include <sys/ioctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace spall {

using namespace std::chrono_literals;

Progress::Progress() : terminal(isatty(STDERR_FILENO) != 0) {}

bool Progress::due() const {
  if (terminal) return Clock::now() - last > 200ms;
  return std::chrono::duration<double>(Clock::now() - start).count() > next_line;
}

void Progress::show(const std::string& text) {
  if (!due()) return;
  if (!terminal) {
    std::printf("%s\n", text.c_str());
    std::fflush(stdout);
    next_line *= 2;
    return;
  }
  winsize size{};
  const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  const std::string line = fit_to_columns(text, known ? size.ws_col : 80);
  std::fprintf(stderr, "\r%-*s", static_cast<int>(shown), line.c_str());
  shown = line.size();
  last = Clock::now();
}

void Progress::clear() {
  if (shown > 0) std::fprintf(stderr, "\r%*s\r", static_cast<int>(shown), "");
  shown = 0;
}

std::string fit_to_columns(const std::string& text, int columns) {
  const std::size_t room = static_cast<std::size_t>(std::max(columns, 5)) - 1;
  return text.size() <= room ? text : text.substr(0, room - 3) + "...";
}

std::string format_duration(double seconds) {
  char text[32];
  if (seconds < 60)
    std::snprintf(text, sizeof text, "%.1f s", seconds);
  else
    std::snprintf(text, sizeof text, "%d:%02d min", static_cast<int>(seconds / 60),
                  static_cast<int>(seconds) % 60);
  return text;
}

double processor_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

} // namespace spall
