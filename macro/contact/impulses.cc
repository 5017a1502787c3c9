#include "macro/contact/impulses.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace spall {
namespace {

/// The parts (nodes with weights) of the n-th touch.
struct Parts {
  const ImpulseSystem::Part *first, *last;
  Parts(const ImpulseSystem& system, std::size_t n)
      : first(system.parts.data() + system.start[n]), last(system.parts.data() + system.start[n + 1]) {}
  const ImpulseSystem::Part* begin() const { return first; }
  const ImpulseSystem::Part* end() const { return last; }
};

/// Returns the velocity of the secondary point relative to its patch, m/s.
Vec3 velocity(const ImpulseSystem& system, const Parts& parts) {
  Vec3 v{};
  for (const auto& part : parts) v += part.weight * times(part.map, system.nodes[part.node].velocity);
  return v;
}

/// Adds an impulse to the secondary point and subtracts it from the patch.
void exchange(ImpulseSystem& system, const Parts& parts, const Vec3& impulse) {
  for (const auto& part : parts) {
    ImpulseSystem::Node& point = system.nodes[part.node];
    point.velocity += part.weight * point.inverse_mass * times_transposed(part.map, impulse);
  }
}

/// Sets the mobilities of a touch: the relative normal velocity per normal impulse, and a bound of the
/// tangential one. A point may be in the patch several times, with its images.
void set_mobilities(Touch& touch, const ImpulseSystem& system, const Parts& parts,
                    std::vector<std::pair<Vec3, double>>& sums) {
  for (const auto& part : parts) {
    auto& [normal, size] = sums[part.node];
    normal += part.weight * times_transposed(part.map, touch.patch.normal);
    size += std::abs(part.weight);
  }
  touch.normal_mobility = touch.tangent_mobility = 0;
  for (const auto& part : parts) { // each node's sum is used once and reset
    auto& [normal, size] = sums[part.node];
    touch.normal_mobility += system.nodes[part.node].inverse_mass * dot(normal, normal);
    touch.tangent_mobility += system.nodes[part.node].inverse_mass * size * size;
    normal = {}, size = 0;
  }
}

/// Relative velocity per impulse of a hold: sum over its nodes of B B^T / mass, B: the node's parts together.
Mat3 mobility_of(const ImpulseSystem& system, const Parts& parts, std::vector<Mat3>& sums) {
  for (const auto& part : parts) sums[part.node] += part.weight * part.map;
  Mat3 mobility{};
  for (const auto& part : parts) { // each node's sum is used once and reset
    Mat3& sum = sums[part.node];
    mobility += system.nodes[part.node].inverse_mass * multiply(sum, transpose(sum));
    sum = {};
  }
  return mobility;
}

} // namespace

Vec3 relative_velocity(const ImpulseSystem& system, std::size_t n) { return velocity(system, {system, n}); }

Vec3 relative_of(const ImpulseSystem& system, std::size_t n, const std::vector<Vec3>& of_nodes) {
  Vec3 v{};
  for (const auto& part : Parts(system, n)) v += part.weight * times(part.map, of_nodes[part.node]);
  return v;
}

ImpulseSystem gather_system(const std::vector<Touch>& touches, const std::vector<ContactBody>& bodies) {
  ImpulseSystem system;
  constexpr std::uint32_t absent = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::vector<std::uint32_t>> place(bodies.size()); // place of each owned point among the nodes
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
    system.parts.push_back({node, weight, bodies[body].image_map(i)});
  };
  for (const Touch& touch : touches) {
    system.start.push_back(static_cast<std::uint32_t>(system.parts.size()));
    add_part(touch.secondary_body, touch.secondary, 1);
    for (const PatchPoint& p : touch.patch.points) add_part(touch.primary_body, p.index, -p.weight);
  }
  system.start.push_back(static_cast<std::uint32_t>(system.parts.size()));
  return system;
}

void apply_system(const ImpulseSystem& system, const std::vector<ContactBody>& bodies) {
  for (const auto& node : system.nodes) bodies[node.body].points->velocity.set(node.index, node.velocity);
}

void solve_impulses(std::vector<Touch>& touches, ImpulseSystem& system, const Friction& friction) {
  double largest = 0;
  // Slip velocities before the impulses: the iteration then solves one fixed problem.
  std::vector<double> slip(touches.size());
  std::vector<std::pair<Vec3, double>> sums(system.nodes.size());
  for (std::size_t t = 0; t < touches.size(); ++t) {
    const Parts parts(system, t);
    set_mobilities(touches[t], system, parts, sums);
    const Vec3 before = touches[t].before = velocity(system, parts), &n = touches[t].patch.normal;
    slip[t] = norm(before - dot(before, n) * n);
    largest = std::max(largest, touches[t].target - dot(before, n));
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
      const Vec3 tangential = touch.impulse - old * n - (v - approach * n) / touch.tangent_mobility;
      const double size = norm(tangential), limit = friction.largest_impulse(normal, slip[t], touch.face_dt);
      const double part_held = size > limit ? limit / size : 1;
      const Vec3 step = normal * n + part_held * tangential - touch.impulse;
      touch.impulse += step;
      exchange(system, parts, step);
      change = std::max(change, norm(step) * touch.normal_mobility);
    }
    if (change <= sweep_tolerance * largest) break;
  }
}

void solve_holds(std::vector<Hold>& holds, ImpulseSystem& system) {
  double largest = 0;
  std::vector<Mat3> sums(system.nodes.size()), inverse_mobility;
  for (std::size_t h = 0; h < holds.size(); ++h) {
    const Parts parts(system, h);
    inverse_mobility.push_back(inverse(mobility_of(system, parts, sums)));
    holds[h].before = velocity(system, parts);
    largest = std::max(largest, norm(holds[h].target - holds[h].before));
  }
  for (std::size_t h = 0; h < holds.size(); ++h) exchange(system, {system, h}, holds[h].impulse);
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    double change = 0;
    for (std::size_t h = 0; h < holds.size(); ++h) {
      const Parts parts(system, h);
      const Vec3 missing = holds[h].target - velocity(system, parts);
      const Vec3 step = times(inverse_mobility[h], missing);
      holds[h].impulse += step;
      exchange(system, parts, step);
      change = std::max(change, norm(missing));
    }
    if (change <= sweep_tolerance * largest) break;
  }
}

} // namespace spall
