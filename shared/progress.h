#pragma once

#include <chrono>
#include <string>

namespace spall {

/// One line that rewrites itself on a terminal, about five times a second; prints nothing when standard error
/// is not a terminal, so that logs stay short.
class Progress {
public:
  Progress();
  ~Progress() { clear(); }
  /// True if it is time for a new line: lets the caller skip building the text.
  bool due() const;
  void show(const std::string& text);
  void clear();
  bool on_terminal() const { return terminal; }

private:
  bool terminal;
  std::size_t shown = 0;
  std::chrono::steady_clock::time_point last{};
};

/// "12.3 s", "4:05 min", for remaining times.
std::string format_duration(double seconds);

/// Processor time of this process so far, all threads, user and system, s.
double processor_seconds();

/// Time since it was made, s.
class Stopwatch {
public:
  double seconds() const { ///< on the wall
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  /// Of the processor, all threads: what a run costs, whoever else is on the machine.
  double cpu_seconds() const { return processor_seconds() - cpu_start; }

private:
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
  double cpu_start = processor_seconds();
};

/// Adds the wall time from its construction, or the last split, to sums, s.
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
