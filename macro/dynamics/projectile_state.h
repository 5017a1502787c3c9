#pragma once

#include "macro/dynamics/simulation.h"

namespace spall {

/// Where the projectile is and how it moves, whatever it is made of.
struct ProjectileState {
  double front = 0, rear = 0; ///< largest and smallest z, m
  Vec3 velocity{};            ///< of the centre of mass, m/s
  Vec3 axis{0, 0, 1};         ///< unit vector from tail to tip
  Vec3 turning{};             ///< angular velocity, rad/s

  /// Negative if it flies back.
  double speed() const { return std::copysign(std::sqrt(dot(velocity, velocity)), velocity[2]); }
};
ProjectileState projectile_of(const Simulation& run);

} // namespace spall
