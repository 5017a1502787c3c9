#pragma once

#include "macro/shape/shape.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace spall {

/// Extent of a body along each axis of its frame, m.
inline Vec3 sizes(const Shape& shape) {
  const auto along = [&](const Vec3& axis) { return extent(shape, axis) + extent(shape, -axis); };
  return {along({1, 0, 0}), along({0, 1, 0}), along({0, 0, 1})};
}

/// Smallest extent along an axis, m.
inline double smallest_size(const Shape& shape) {
  const auto [x, y, z] = sizes(shape);
  return std::min({x, y, z});
}

/// A ball around a body, in its frame; its radius is infinite for a body without end.
struct BoundingBall {
  Vec3 centre;   ///< m
  double radius; ///< m
};
inline BoundingBall bounding_ball(const Shape& shape) {
  const double radius = 0.5 * norm(sizes(shape));
  if (!std::isfinite(radius)) return {{}, radius};
  const auto middle = [&](const Vec3& axis) { return 0.5 * (extent(shape, axis) - extent(shape, -axis)); };
  return {{middle({1, 0, 0}), middle({0, 1, 0}), middle({0, 0, 1})}, radius};
}

/// Samples of the surface of a body at which another one may touch it: a twentieth of the size of the smaller
/// one apart, or more where the body is so large that there would be too many along it. A body without end
/// has none.
/// @param size of the smaller one, m  @param most_along samples along the body
inline std::vector<Vec3> samples_for(const Shape& shape, double size, double most_along) {
  constexpr double spacing = 0.05;
  const auto [x, y, z] = sizes(shape);
  const double largest = std::max({x, y, z});
  return std::isfinite(largest) ? surface_samples(shape, std::max(spacing * size, largest / most_along))
                                : std::vector<Vec3>();
}

} // namespace spall
