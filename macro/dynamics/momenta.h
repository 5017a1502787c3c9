#pragma once

#include "macro/contact/rigid_body.h"
#include "macro/solid/solid.h"

namespace spall {

/// Of everything that moves, about the origin; SI.
struct Momenta {
  Vec3 linear{}, angular{};
  double linear_size = 0, angular_size = 0; ///< sums of magnitudes: what round-off is measured against
};
Momenta momenta_of(const std::vector<std::unique_ptr<Solid>>& solids, const RigidBody& body);

/// Changes, relative to the larger of the sizes; of the components that symmetry planes leave alone.
struct MomentumError {
  double linear = 0, angular = 0;
};
MomentumError compare(const Momenta& before, const Momenta& now, const SymmetryPlanes& planes);

} // namespace spall
