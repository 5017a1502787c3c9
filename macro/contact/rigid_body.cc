#include "macro/contact/rigid_body.h"

namespace spall {

Mat3 RigidBody::inverse_inertia() const {
  const Mat3 r = inertia_axes();
  Mat3 inverse{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (turns[i] && turns[j])
        for (int k = 0; k < 3; ++k) inverse[3 * i + j] += r[3 * i + k] * r[3 * j + k] / moments[k];
  return inverse;
}

double RigidBody::kinetic_energy() const {
  if (held()) return 0;
  return 0.5 * (mass * dot(velocity, velocity) + dot(angular_momentum, angular_velocity()));
}

void RigidBody::receive(const Vec3& impulse, const Vec3& angular) {
  for (int c = 0; c < 3; ++c) {
    if (free[c]) velocity[c] += impulse[c] / mass;
    if (turns[c]) angular_momentum[c] += angular[c];
  }
}

void RigidBody::move(double dt) {
  if (!can_turn()) {
    position = add(position, dt, velocity);
    return;
  }
  const Vec3 there = add(centre_of_mass(), dt, velocity);
  Vec3 spin = times_transposed(inertia_axes(), angular_momentum); // along the axes of inertia
  orientation = orientation * principal;
  constexpr std::array<std::pair<int, double>, 5> turn = {{{0, 0.5}, {1, 0.5}, {2, 1}, {1, 0.5}, {0, 0.5}}};
  for (const auto& [axis, part] : turn) {
    const Quaternion q = about_axis(axis, part * dt * spin[axis] / moments[axis]);
    orientation = orientation * q;
    spin = times_transposed(matrix_of(q), spin);
  }
  orientation = normalized(orientation * conjugate(principal));
  position = add(there, -1, times(matrix_of(orientation), centre));
}

double RigidBody::front() const {
  return position[2] + extent(shape, times_transposed(matrix_of(orientation), {0, 0, 1}));
}

double RigidBody::rear() const {
  return position[2] - extent(shape, times_transposed(matrix_of(orientation), {0, 0, -1}));
}

} // namespace spall
