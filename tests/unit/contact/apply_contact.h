#pragma once

#include "macro/contact/rigid_contact.h"

namespace spall::test {

/// Both sides of the contact, where all points are at hand.
inline RigidContactReport apply_contact(Points& points, RigidBody& body, const ContactInputs& inputs,
                                        double dt, double kick) {
  RigidContactReport sum = push_points(points, body, inputs, dt, kick);
  push_body(body, sum);
  return sum;
}

} // namespace spall::test
