#pragma once

#include <chrono>
#include <string>

namespace spall {

/// Shows how far a computation has come. On a terminal (standard error) one line is overwritten about five
/// times a second, cut to the width of the terminal. Elsewhere lines go to standard output, the first after
/// `first_line` seconds, each of the next after twice the time: a log of a day has a dozen.
class Progress {
public:
  static constexpr double first_line = 10; ///< s

  Progress();
  ~Progress() { clear(); }
  /// True if a line may be shown now, so that the caller can skip building the text otherwise.
  bool due() const;
  void show(const std::string& text);
  void clear();

private:
  using Clock = std::chrono::steady_clock;
  bool terminal;
  std::size_t shown = 0; ///< characters on the terminal
  Clock::time_point start = Clock::now(), last{};
  double next_line = first_line; ///< time of the next line of a log since the start, s
};

/// Cuts a line to fewer characters than a terminal has columns; the end of a line that is cut is "...".
std::string fit_to_columns(const std::string& text, int columns);

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
