#pragma once

#include "macro/dynamics/bodies.h"

#include <cmath>
#include <string>

namespace spall {

/// Where a body is and how it moves, whatever it is made of.
struct BodyMotion {
  double front = 0, rear = 0; ///< largest and smallest z, m
  Vec3 place{};               ///< of a rigid body's origin, of a deformable one's centre of mass, m
  Vec3 velocity{};            ///< of the centre of mass, m/s
  Vec3 axis{0, 0, 1};         ///< unit vector along the body; of a projectile from tail to tip
  Quaternion attitude{};      ///< turns z into the axis, and the frame of a rigid body into space
  Vec3 turning{};             ///< angular velocity, rad/s

  /// Negative if it flies back.
  double speed() const { return std::copysign(norm(velocity), velocity[2]); }
};

/// Of a deformable body, by least squares: the rigid motion that carries the same momenta. Its axis starts as
/// that of its known surface, else along z. All ranks must call it.
BodyMotion motion_of(const Solid& solid);
/// Of a rigid body; one without a finite length has front and rear in the origin of its frame.
BodyMotion motion_of(const RigidBody& body);
/// Of the deformable or rigid body of that name. All ranks must call it. @throws std::out_of_range
BodyMotion motion_of(const Bodies& bodies, const std::string& name);

} // namespace spall
