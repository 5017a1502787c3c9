#pragma once

#include "macro/contact/contact_inputs.h"
#include "macro/contact/contact_report.h"
#include "macro/contact/rigid_body.h"

namespace spall {

/// Results of the contact with a rigid body in one step.
struct RigidContactReport : ContactReport {
  Vec3 impulse{};         ///< impulse on the rigid body, N s
  Vec3 angular_impulse{}; ///< angular impulse on the rigid body about its centre of mass, N m s

  RigidContactReport& operator+=(const RigidContactReport& other);
  void list(Reduction& of_ranks);
};

/// The law "points" between a deformable and a rigid body: contact of the points' cells, with friction. A
/// cell touches with its face, half of its present extent along the normal away from the point (nothing where
/// points lie on the surface of their body), or half of that of its solid part (TouchingPart). Every point
/// whose face would be inside at the end of the step gets the impulse that leaves the face on the surface,
/// and a tangential one by Coulomb's law (paper Eqs. 13-16 integrated over the step: stick if that needs less
/// than mu times the normal impulse, else slip); the body gets the opposite at the same place, so linear and
/// angular momentum are kept exactly. There is no dashpot: approaching points are stopped anyway, and a
/// dashpot on separating points would exert tension (with 0.3 of the velocity the force of the slab at 17 mm
/// is 15 % less noisy and the exit velocity 0.6 m/s higher). An existing overlap is removed slowly, so that
/// it cannot accelerate a point away. The function changes the velocities of the points, not their positions.
/// The velocities include the velocity change of the internal force over the time `kick` (s) already; it is
/// subtracted for the work.
RigidContactReport push_points(Points& points, const RigidBody& body, const ContactInputs& inputs, double dt,
                               double kick);
/// Applies the sum of the impulses of all points (of all bodies, on all ranks) to the rigid body: changes its
/// velocities and adds its part to the energy loss.
void push_body(RigidBody& body, RigidContactReport& sum);

} // namespace spall
