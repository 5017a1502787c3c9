#include "macro/dynamics/projectile_state.h"

#include <algorithm>
#include <cmath>

namespace spall {

namespace {

/// Of a deformable one, by least squares: the rigid motion that carries the same momenta.
ProjectileState mean_motion(const Solid& solid) {
  const Points& points = solid.points;
  ProjectileState state{.front = -1e300, .rear = 1e300};
  double mass = 0;
  Vec3 centre{}, start{};
  for (std::size_t i = 0; i < points.owned; ++i) {
    const double m = points.mass[i], z = points.position.component[2][i], half = 0.5 * points.spacing[i];
    mass += m;
    centre = add(centre, m, points.position[i]);
    start = add(start, m, points.initial_position[i]);
    state.velocity = add(state.velocity, m, points.velocity[i]);
    state.front = std::max(state.front, z + half);
    state.rear = std::min(state.rear, z - half);
  }
  for (Vec3* sum : {&centre, &start, &state.velocity})
    for (double& a : *sum) a /= mass;
  const Vec3 axis = times(solid.surface->axes, {0, 0, 1});
  Vec3 along{};
  double spin = 0, inertia = 0; // about y, the only axis that a plane of flight leaves
  for (std::size_t i = 0; i < points.owned; ++i) {
    const double m = points.mass[i];
    const Vec3 x = add(points.position[i], -1, centre), v = add(points.velocity[i], -1, state.velocity);
    along = add(along, m * dot(axis, add(points.initial_position[i], -1, start)), x);
    spin += m * cross(x, v)[1];
    inertia += m * (x[0] * x[0] + x[2] * x[2]);
  }
  const SymmetryPlanes& planes = solid.ghosts.symmetry();
  for (int c = 0; c < 3; ++c) // what the images cancel
    if (!planes.moves_along(c)) along[c] = state.velocity[c] = 0;
  state.axis = add({}, 1 / std::sqrt(dot(along, along)), along);
  state.turning = {0, planes.turns_about(1) ? spin / inertia : 0, 0};
  return state;
}

} // namespace

ProjectileState projectile_of(const Simulation& run) {
  if (const Solid* solid = run.find("projectile")) return mean_motion(*solid);
  const RigidBody& body = run.body;
  return {.front = body.front(),
          .rear = body.rear(),
          .velocity = body.velocity,
          .axis = times(matrix_of(body.orientation), {0, 0, 1}),
          .turning = body.angular_velocity()};
}

} // namespace spall
