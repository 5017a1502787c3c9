#include "shared/progress.h"

#include <sys/resource.h>
#include <unistd.h>

#include <cstdio>

namespace spall {

using namespace std::chrono_literals;

Progress::Progress() : terminal(isatty(STDERR_FILENO) != 0) {}

bool Progress::due() const { return terminal && std::chrono::steady_clock::now() - last > 200ms; }

void Progress::show(const std::string& text) {
  if (!due()) return;
  std::fprintf(stderr, "\r%-*s", static_cast<int>(shown), text.c_str());
  shown = text.size();
  last = std::chrono::steady_clock::now();
}

void Progress::clear() {
  if (shown > 0) std::fprintf(stderr, "\r%*s\r", static_cast<int>(shown), "");
  shown = 0;
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
