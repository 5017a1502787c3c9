#pragma once

#include <cmath>

namespace spall {

/// Value and slope of a function.
struct ValueAndSlope {
  double value, slope;
};

/// Returns the root of an increasing function between `low` and `high`, where it is not positive and not
/// negative: Newton's method from `start`, and bisection where that leaves the bracket.
/// @param f f(x) returns ValueAndSlope  @param tolerance largest |f| of a root
template<class F> double increasing_root(F f, double low, double high, double start, double tolerance) {
  constexpr int most_iterations = 100; // bisection alone needs 50 or so
  double x = start;
  for (int k = 0; k < most_iterations; ++k) {
    const ValueAndSlope at = f(x);
    if (std::abs(at.value) <= tolerance) break;
    (at.value > 0 ? high : low) = x;
    x -= at.value / at.slope;
    if (!(x > low && x < high)) x = (low + high) / 2;
  }
  return x;
}

} // namespace spall
