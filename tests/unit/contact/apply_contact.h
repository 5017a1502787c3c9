#pragma once

#include "macro/contact/rigid_contact.h"

namespace spall::test {

/// Applies a contact step to the points and to the body, on a single rank.
inline RigidContactReport apply_contact(Points& points, RigidBody& body, const ContactInputs& inputs,
                                        double dt, double kick) {
  RigidContactReport sum = push_points(points, body, inputs, dt, kick);
  push_body(body, sum);
  return sum;
}

} // namespace spall::test
