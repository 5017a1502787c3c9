#pragma once

#include "macro/contact/contact_inputs.h"
#include "macro/contact/contact_report.h"
#include "macro/contact/rigid_body.h"

namespace spall {

/// What contact with a rigid body has done in one step.
struct RigidContactReport : ContactReport {
  Vec3 impulse{};         ///< on the rigid body, N s
  Vec3 angular_impulse{}; ///< on the rigid body about its centre of mass, N m s

  RigidContactReport& operator+=(const RigidContactReport& other);
  void list(Reduction& of_ranks);
};

/// The law "points" between a deformable and a rigid body: point contact with friction. Every point that
/// would be inside at the end of the step gets the impulse that leaves it on the surface, and a tangential
/// one by Coulomb's law (paper Eqs. 13-16 integrated over the step: stick if that needs less than mu times
/// the normal impulse, else slip); the body gets the opposite at the same place, so linear and angular
/// momentum are kept exactly. No dashpot: what approaches is stopped anyway, and one that holds back what
/// parts would pull (0.3 of the velocity: the force of the slab at 17 mm is 15 % less noisy, the exit
/// velocity 0.6 m/s higher). An overlap that already exists is taken back slowly, so that it cannot throw a
/// point away. Changes velocities of points; positions are left to the caller. The velocities of the points
/// hold the internal force's `kick` (s) already; it is taken off again for the work.
RigidContactReport push_points(Points& points, const RigidBody& body, const ContactInputs& inputs, double dt,
                               double kick);
/// The body's side of it, once the impulses of all points (of all bodies, on all ranks) are added up: changes
/// its velocities, and completes the loss by its own part.
void push_body(RigidBody& body, RigidContactReport& sum);

} // namespace spall
