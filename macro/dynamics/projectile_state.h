#pragma once

#include "macro/solid/solid.h"

#include <cmath>

namespace spall {

class Simulation;

/// Where the projectile is and how it moves, whatever it is made of.
struct ProjectileState {
  double front = 0, rear = 0; ///< largest and smallest z, m
  Vec3 velocity{};            ///< of the centre of mass, m/s
  Vec3 axis{0, 0, 1};         ///< unit vector from tail to tip
  Vec3 turning{};             ///< angular velocity, rad/s

  /// Negative if it flies back.
  double speed() const { return std::copysign(std::sqrt(dot(velocity, velocity)), velocity[2]); }
};
/// Of a deformable one, by least squares: the rigid motion that carries the same momenta. All ranks must call
/// it.
ProjectileState mean_motion(const Solid& solid);
ProjectileState projectile_of(const Simulation& run);

} // namespace spall
