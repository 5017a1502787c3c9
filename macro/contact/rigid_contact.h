#pragma once

#include "macro/contact/contact_inputs.h"
#include "macro/contact/rigid_body.h"
#include "shared/ranks.h"

namespace spall {

/// What the contact did in one step. The losses are minus the work of the impulses on points and body
/// together.
struct ContactReport {
  Vec3 impulse{};                  ///< on the rigid body, N s
  Vec3 angular_impulse{};          ///< on the rigid body about its centre of mass, N m s
  double normal_loss = 0;          ///< energy lost by normal impulses (points are stopped without rebound), J
  double friction_loss = 0;        ///< energy lost by friction, J
  double deepest = 0;              ///< deepest overlap at the start of the step, m
  std::size_t touching = 0;        ///< points that got an impulse
  double gap_sum = 0, gap_max = 0; ///< |gap| of touching points at the start of the step, m

  ContactReport& operator+=(const ContactReport& other);
  void list(Reduction& of_ranks);
};

/// Point contact with a rigid surface. Every point that would be inside at the end of the step gets the
/// impulse that leaves it on the surface, and a tangential one by Coulomb's law (paper Eqs. 13-16 integrated
/// over the step: stick if that needs less than mu times the normal impulse, else slip); the body gets the
/// opposite at the same place, so linear and angular momentum are kept exactly. No dashpot: what approaches
/// is stopped anyway, and one that holds back what parts would pull (0.3 of the velocity: the force of the
/// slab at 17 mm is 15 % less noisy, the exit velocity 0.6 m/s higher). An overlap that already exists is
/// taken back slowly, so that it cannot throw a point away. Changes velocities of points; positions are left
/// to the caller. The velocities of the points hold the internal force's `kick` (s) already; it is taken off
/// again for the work.
ContactReport push_points(Points& points, const RigidBody& body, const ContactInputs& inputs, double dt,
                          double kick);
/// The body's side of it, once the impulses of all points (of all bodies, on all ranks) are added up: changes
/// its velocities, and completes the loss by its own part.
void push_body(RigidBody& body, ContactReport& sum);

} // namespace spall
