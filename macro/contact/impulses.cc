#include "macro/contact/impulses.h"

#include "macro/points/quaternion.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace spall {
namespace {

/// Parts of the n-th touch.
struct Parts {
  const ImpulseSystem::Part *first, *last;
  Parts(const ImpulseSystem& system, std::size_t n)
      : first(system.parts.data() + system.start[n]), last(system.parts.data() + system.start[n + 1]) {}
  const ImpulseSystem::Part* begin() const { return first; }
  const ImpulseSystem::Part* end() const { return last; }
};

/// Of the slave relative to its patch.
Vec3 velocity(const ImpulseSystem& system, const Parts& parts) {
  Vec3 v{};
  for (const auto& part : parts) v = add(v, part.weight, times(part.map, system.nodes[part.node].velocity));
  return v;
}

/// Gives the slave an impulse and takes it from the master.
void exchange(ImpulseSystem& system, const Parts& parts, const Vec3& impulse) {
  for (const auto& part : parts) {
    ImpulseSystem::Node& point = system.nodes[part.node];
    point.velocity =
        add(point.velocity, part.weight * point.inverse_mass, times_transposed(part.map, impulse));
  }
}

/// Relative velocity along the normal per impulse along it, and a bound of the tangential one. An owner may
/// be in the patch several times, with its images.
void set_mobilities(Touch& touch, const ImpulseSystem& system, const Parts& parts,
                    std::vector<std::pair<Vec3, double>>& sums) {
  for (const auto& part : parts) {
    auto& [normal, size] = sums[part.node];
    normal = add(normal, part.weight, times_transposed(part.map, touch.patch.normal));
    size += std::abs(part.weight);
  }
  touch.normal_mobility = touch.tangent_mobility = 0;
  for (const auto& part : parts) { // a node's sum is taken once and left empty
    auto& [normal, size] = sums[part.node];
    touch.normal_mobility += system.nodes[part.node].inverse_mass * dot(normal, normal);
    touch.tangent_mobility += system.nodes[part.node].inverse_mass * size * size;
    normal = {}, size = 0;
  }
}

} // namespace

ImpulseSystem gather_system(const std::vector<Touch>& touches, const std::vector<ContactBody>& bodies) {
  ImpulseSystem system;
  constexpr std::uint32_t absent = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::vector<std::uint32_t>> place(bodies.size()); // of an owned point among the nodes
  for (std::size_t b = 0; b < bodies.size(); ++b) place[b].assign(bodies[b].points->owned, absent);
  const auto add_part = [&](std::size_t body, std::uint32_t i, double weight) {
    const Points& points = *bodies[body].points;
    const Ghosts& ghosts = *bodies[body].ghosts;
    const std::uint32_t owner = ghosts.owner(points, i);
    std::uint32_t& node = place[body][owner];
    if (node == absent) {
      node = static_cast<std::uint32_t>(system.nodes.size());
      system.nodes.push_back(
          {static_cast<std::uint32_t>(body), owner, 1 / points.mass[owner], points.velocity[owner]});
    }
    const Vec3 x = ghosts.mirror(points, i, {1, 0, 0}), y = ghosts.mirror(points, i, {0, 1, 0}),
               z = ghosts.mirror(points, i, {0, 0, 1});
    system.parts.push_back({node, weight, {x[0], y[0], z[0], x[1], y[1], z[1], x[2], y[2], z[2]}});
  };
  for (const Touch& touch : touches) {
    system.start.push_back(static_cast<std::uint32_t>(system.parts.size()));
    add_part(touch.slave_body, touch.slave, 1);
    for (const PatchPoint& p : touch.patch.points) add_part(touch.master_body, p.index, -p.weight);
  }
  system.start.push_back(static_cast<std::uint32_t>(system.parts.size()));
  return system;
}

void apply_system(const ImpulseSystem& system, const std::vector<ContactBody>& bodies) {
  for (const auto& node : system.nodes) bodies[node.body].points->velocity.set(node.index, node.velocity);
}

void solve_impulses(std::vector<Touch>& touches, ImpulseSystem& system, double friction) {
  double largest = 0;
  std::vector<std::pair<Vec3, double>> sums(system.nodes.size());
  for (std::size_t t = 0; t < touches.size(); ++t) {
    const Parts parts(system, t);
    set_mobilities(touches[t], system, parts, sums);
    touches[t].before = velocity(system, parts);
    largest = std::max(largest, touches[t].target - dot(touches[t].before, touches[t].patch.normal));
  }
  // The impulses of the last step are a good guess: a body at rest on another needs no sweeps.
  for (std::size_t t = 0; t < touches.size(); ++t) exchange(system, {system, t}, touches[t].impulse);
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    double change = 0;
    for (std::size_t t = 0; t < touches.size(); ++t) {
      Touch& touch = touches[t];
      const Parts parts(system, t);
      const Vec3& n = touch.patch.normal;
      const Vec3 v = velocity(system, parts);
      const double approach = dot(v, n), old = dot(touch.impulse, n);
      const double normal = std::max(0.0, old + (touch.target - approach) / touch.normal_mobility);
      // Tangential: stick, unless that needs more than friction times the normal impulse.
      Vec3 tangential;
      for (int c = 0; c < 3; ++c)
        tangential[c] = touch.impulse[c] - old * n[c] - (v[c] - approach * n[c]) / touch.tangent_mobility;
      const double size = std::sqrt(dot(tangential, tangential)), limit = friction * normal;
      const double kept = size > limit ? limit / size : 1;
      Vec3 step;
      for (int c = 0; c < 3; ++c) step[c] = normal * n[c] + kept * tangential[c] - touch.impulse[c];
      for (int c = 0; c < 3; ++c) touch.impulse[c] += step[c];
      exchange(system, parts, step);
      change = std::max(change, std::sqrt(dot(step, step)) * touch.normal_mobility);
    }
    if (change <= sweep_tolerance * largest) break;
  }
}

} // namespace spall
