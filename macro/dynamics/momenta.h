#pragma once

#include "macro/dynamics/bodies.h"

namespace spall {

/// Momenta of everything that moves, about the origin; SI.
struct Momenta {
  Vec3 linear{}, angular{};
  double linear_size = 0, angular_size = 0; ///< sums of magnitudes: what round-off is measured against
};
/// All ranks must call it.
Momenta momenta_of(const Bodies& bodies);

/// Changes of the components that symmetry planes leave alone, relative to the larger of the sizes.
struct MomentumError {
  double linear = 0, angular = 0;
};
MomentumError compare(const Momenta& before, const Momenta& now, const SymmetryPlanes& planes);

} // namespace spall
