#include "macro/dynamics/body_motion.h"

#include <algorithm>
#include <cmath>

namespace spall {

BodyMotion motion_of(const Solid& solid) {
  const Points& points = solid.points;
  BodyMotion state{.front = -1e300, .rear = 1e300};
  const Ranks& ranks = solid.ghosts.processes();
  std::vector<double> sums(10);
  for (std::size_t i = 0; i < points.owned; ++i) {
    const double m = points.mass[i], z = points.position.component[2][i], half = 0.5 * points.spacing[i];
    sums[0] += m;
    for (int c = 0; c < 3; ++c) {
      sums[1 + c] += m * points.position.component[c][i];
      sums[4 + c] += m * points.initial_position.component[c][i];
      sums[7 + c] += m * points.velocity.component[c][i];
    }
    state.front = std::max(state.front, z + half);
    state.rear = std::min(state.rear, z - half);
  }
  ranks.sum(sums);
  const auto mean = [&sums](int k) {
    return Vec3{sums[k] / sums[0], sums[k + 1] / sums[0], sums[k + 2] / sums[0]};
  };
  const Vec3 centre = mean(1), start = mean(4);
  state.velocity = mean(7);
  state.place = centre;
  state.front = ranks.max(state.front), state.rear = ranks.min(state.rear);
  const Vec3 axis = solid.surface ? times(solid.surface->axes, {0, 0, 1}) : Vec3{0, 0, 1};
  std::vector<double> turns(5); // along the axis; about y, the only axis that a plane of flight leaves
  for (std::size_t i = 0; i < points.owned; ++i) {
    const double m = points.mass[i];
    const Vec3 x = points.position[i] - centre, v = points.velocity[i] - state.velocity;
    const double height = dot(axis, points.initial_position[i] - start);
    for (int c = 0; c < 3; ++c) turns[c] += m * height * x[c];
    turns[3] += m * cross(x, v)[1];
    turns[4] += m * (x[0] * x[0] + x[2] * x[2]);
  }
  ranks.sum(turns);
  Vec3 along = {turns[0], turns[1], turns[2]};
  const SymmetryPlanes& planes = solid.ghosts.symmetry();
  for (int c = 0; c < 3; ++c) // what the images cancel
    if (!planes.moves_along(c)) along[c] = state.velocity[c] = state.place[c] = 0;
  const double length = norm(along); // a point has none
  state.axis = length > 0 ? 1 / length * along : axis;
  state.attitude = from_z_to(state.axis);
  state.turning = {0, planes.turns_about(1) && turns[4] > 0 ? turns[3] / turns[4] : 0, 0};
  return state;
}

BodyMotion motion_of(const RigidBody& body) {
  return {.front = body.front(),
          .rear = body.rear(),
          .place = body.position,
          .velocity = body.velocity,
          .axis = times(matrix_of(body.orientation), {0, 0, 1}),
          .attitude = body.orientation,
          .turning = body.angular_velocity()};
}

BodyMotion motion_of(const Bodies& bodies, const std::string& name) {
  const std::size_t index = bodies.index(name);
  if (index < bodies.solids.size()) return motion_of(*bodies.solids[index]);
  return motion_of(bodies.rigids[index - bodies.solids.size()]);
}

} // namespace spall
