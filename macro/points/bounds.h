#pragma once

#include "macro/points/points.h"

#include <algorithm>

namespace spall {

/// Axis-aligned box.
struct Bounds {
  Vec3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};

  bool holds(const Vec3& x) const {
    for (int c = 0; c < 3; ++c)
      if (x[c] < low[c] || x[c] > high[c]) return false;
    return true;
  }
  bool overlaps(const Bounds& other) const {
    for (int c = 0; c < 3; ++c)
      if (high[c] < other.low[c] || other.high[c] < low[c]) return false;
    return true;
  }
  /// Grows to hold the box x +- half.
  void add(const Vec3& x, const Vec3& half = {}) {
    for (int c = 0; c < 3; ++c)
      low[c] = std::min(low[c], x[c] - half[c]), high[c] = std::max(high[c], x[c] + half[c]);
  }
};

} // namespace spall
