#pragma once

#include "macro/shape/shape.h"

#include <array>
#include <cstdint>
#include <vector>

namespace spall {

/// A closed surface of triangles, in the frame of its body.
struct Triangles {
  std::vector<Vec3> points;                         ///< m
  std::vector<std::array<std::int64_t, 3>> corners; ///< indices of points, anticlockwise as seen from outside
};

/// Returns the surface of a body for pictures: its outline turned about z in steps of 7.5 degrees, or the six
/// faces of a block. A shape without end has none.
Triangles triangles_of(const Shape& shape);

} // namespace spall
