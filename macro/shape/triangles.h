#pragma once

#include "macro/shape/shape.h"

namespace spall {

/// Returns the surface of a body for pictures: its outline turned about z in steps of 7.5 degrees, the six
/// faces of a block, or the triangles that it consists of. A shape without end has none.
Triangles triangles_of(const Shape& shape);

} // namespace spall
