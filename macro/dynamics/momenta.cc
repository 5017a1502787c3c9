#include "macro/dynamics/momenta.h"

#include <algorithm>
#include <cmath>

namespace spall {

Momenta momenta_of(const Bodies& bodies) {
  Momenta sum;
  const auto count = [&sum](double mass, const Vec3& x, const Vec3& v) {
    const Vec3 turn = cross(x, v);
    sum.linear += mass * v;
    sum.angular += mass * turn;
    sum.linear_size += mass * norm(v);
    sum.angular_size += mass * norm(turn);
  };
  for (const auto& solid : bodies.solids) {
    const Points& points = solid->points;
    for (std::size_t i = 0; i < points.owned; ++i)
      count(points.mass[i], points.position[i], points.velocity[i]);
  }
  std::vector<double> parts = {sum.linear[0],  sum.linear[1],  sum.linear[2],   sum.angular[0],
                               sum.angular[1], sum.angular[2], sum.linear_size, sum.angular_size};
  bodies.ranks().sum(parts);
  sum = {{parts[0], parts[1], parts[2]}, {parts[3], parts[4], parts[5]}, parts[6], parts[7]};
  for (const Reinforcement& bars : bodies.reinforcements) { // the same on all ranks
    const Points& nodes = bars.nodes();
    for (std::size_t i = 0; i < nodes.owned; ++i) count(nodes.mass[i], nodes.position[i], nodes.velocity[i]);
  }
  for (const RigidBody& body : bodies.rigids) {
    if (body.held()) continue;
    count(body.mass, body.centre_of_mass(), body.velocity);
    sum.angular += body.angular_momentum;
    sum.angular_size += norm(body.angular_momentum);
  }
  return sum;
}

MomentumError compare(const Momenta& before, const Momenta& now, const SymmetryPlanes& planes) {
  MomentumError error;
  for (int c = 0; c < 3; ++c) {
    if (planes.moves_along(c))
      error.linear = std::max(error.linear, std::abs(now.linear[c] - before.linear[c]));
    if (planes.turns_about(c))
      error.angular = std::max(error.angular, std::abs(now.angular[c] - before.angular[c]));
  }
  const double linear = std::max(before.linear_size, now.linear_size),
               angular = std::max(before.angular_size, now.angular_size);
  return {linear > 0 ? error.linear / linear : 0, angular > 0 ? error.angular / angular : 0};
}

} // namespace spall
