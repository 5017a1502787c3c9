#pragma once

#include "macro/dynamics/bodies.h"

#include <utility>

namespace spall::test {

/// Makes bodies of one deformable body, and of a rigid one if it is given.
inline Bodies bodies_of(std::unique_ptr<Solid> solid) {
  Bodies bodies;
  bodies.solids.push_back(std::move(solid));
  return bodies;
}
inline Bodies bodies_of(std::unique_ptr<Solid> solid, RigidBody rigid) {
  Bodies bodies = bodies_of(std::move(solid));
  bodies.rigids.push_back(std::move(rigid));
  return bodies;
}

} // namespace spall::test
