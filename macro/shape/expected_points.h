#pragma once

#include "macro/shape/fill.h"

namespace spall {

/// About how many points fill() makes, not fewer than half of them: before anything of their size is made.
double expected_points(const Shape& shape, const Filling& filling, const SymmetryPlanes& planes);

} // namespace spall
