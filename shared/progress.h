#pragma once

#include <chrono>
#include <string>

namespace spall {

/// One line on a terminal that is overwritten about five times a second. Nothing is printed when standard
/// error is not a terminal, so that logs stay short.
class Progress {
public:
  Progress();
  ~Progress() { clear(); }
  /// True if the line may be overwritten now, so that the caller can skip building the text otherwise.
  bool due() const;
  void show(const std::string& text);
  void clear();
  bool on_terminal() const { return terminal; }

private:
  bool terminal;
  std::size_t shown = 0;
  std::chrono::steady_clock::time_point last{};
};

/// Formats a duration for output: "12.3 s" or "4:05 min".
std::string format_duration(double seconds);

/// Returns the processor time of this process so far (user and system), summed over all threads, s.
double processor_seconds();

/// Measures the time since its construction, s.
class Stopwatch {
public:
  double seconds() const { ///< elapsed time
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  /// Processor time since the construction, summed over all threads, s. Other programs on the machine hardly
  /// affect it.
  double cpu_seconds() const { return processor_seconds() - cpu_start; }

private:
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
  double cpu_start = processor_seconds();
};

/// Adds the elapsed time since its construction or the last split to a sum, s.
class PhaseTimer {
public:
  void restart() { last = std::chrono::steady_clock::now(); }
  void split(double& sum) {
    const auto now = std::chrono::steady_clock::now();
    sum += std::chrono::duration<double>(now - last).count();
    last = now;
  }

private:
  std::chrono::steady_clock::time_point last = std::chrono::steady_clock::now();
};

} // namespace spall
