#include "macro/dynamics/projectile_state.h"

namespace spall {

ProjectileState projectile_of(const Simulation& run) {
  const RigidBody& body = run.body;
  return {.front = body.front(),
          .rear = body.rear(),
          .velocity = body.velocity,
          .axis = times(matrix_of(body.orientation), {0, 0, 1}),
          .turning = body.angular_velocity()};
}

} // namespace spall
