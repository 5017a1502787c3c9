#include "macro/contact/rigid_pairs.h"

#include "macro/shape/sizes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace spall {
namespace {

/// Samples along a body at most: of a body that is much larger than the other one some are left out; that one
/// is seen by its own samples.
constexpr double most_samples_along = 200;
/// Overlap of what only touches, as a part of that size.
constexpr double touching_depth = 1e-3;

const std::array<Vec3, 3> axes = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

/// Whether a sample of one surface is deeper than this inside the other body.
bool reaches_into(const RigidBody& one, const std::vector<Vec3>& samples, const RigidBody& other,
                  double depth) {
  const Mat3 turn = matrix_of(one.orientation), back = matrix_of(other.orientation);
  return std::any_of(samples.begin(), samples.end(), [&](const Vec3& x) {
    const Vec3 seen = times_transposed(back, one.position + times(turn, x) - other.position);
    return lower_bound(other.shape, seen) < -depth && surface(other.shape, seen).distance < -depth;
  });
}

/// The way of a body that nothing deflects: from its centre on, as wide as the body is across.
struct Path {
  Vec3 from, along; ///< m; unit vector, or zero for a body at rest
  double radius;    ///< m

  explicit Path(const RigidBody& body)
      : from(body.in_space(bounding_ball(body.shape).centre)), along(body.velocity), radius(0) {
    const double speed = norm(along);
    if (speed > 0) along = 1 / speed * along;
    // The largest extent across the way, of all directions in the body's frame.
    const Vec3 seen = times_transposed(matrix_of(body.orientation), along),
               centre = bounding_ball(body.shape).centre;
    if (!(speed > 0)) {
      radius = 0.5 * norm(sizes(body.shape));
      return;
    }
    const Vec3 side = unit(cross(seen, std::abs(seen[2]) < 0.9 ? axes[2] : axes[0])),
               other = cross(seen, side);
    constexpr int directions = 64; // the largest extent to a thousandth
    for (int k = 0; k < directions; ++k) {
      const double angle = 2 * std::numbers::pi * k / directions;
      const Vec3 across = std::cos(angle) * side + std::sin(angle) * other;
      radius = std::max(radius, extent(body.shape, across) - dot(centre, across));
    }
  }
  /// The distance on the way that is nearest to a place, m.
  double nearest(const Vec3& x) const { return std::max(0.0, dot(x - from, along)); }
};

/// Smallest distance of two rays, m: alternating projections, which converge because rays are convex.
double distance(const Path& a, const Path& b) {
  const double cosine = dot(a.along, b.along), skew = 1 - cosine * cosine;
  const Vec3 between = b.from - a.from;
  double s = 0;
  if (skew > 1e-12) s = std::max(0.0, (dot(between, a.along) - cosine * dot(between, b.along)) / skew);
  for (int k = 0; k < 3; ++k) s = a.nearest(b.from + b.nearest(a.from + s * a.along) * b.along);
  const Vec3 place = a.from + s * a.along;
  return norm(place - b.from - b.nearest(place) * b.along);
}

/// Whether a body flies at a half space, or its path meets that of another body.
bool cross_paths(const RigidBody& a, const RigidBody& b) {
  if (std::isinf(smallest_size(a.shape))) return cross_paths(b, a);
  if (std::holds_alternative<PlaneWall>(b.shape))
    return dot(a.velocity - b.velocity, times(matrix_of(b.orientation), {0, 0, 1})) < 0;
  const Path one(a), other(b);
  return distance(one, other) < one.radius + other.radius;
}

template<class F> void for_each_pair(const std::vector<RigidBody>& bodies, const F& f) {
  for (std::size_t a = 0; a < bodies.size(); ++a)
    for (std::size_t b = a + 1; b < bodies.size(); ++b)
      if (!(bodies[a].held() && bodies[b].held())) f(a, b);
}

} // namespace

RigidPairs::RigidPairs(const std::vector<RigidBody>& bodies) {
  for_each_pair(bodies, [&](std::size_t a, std::size_t b) {
    const double size = std::min(smallest_size(bodies[a].shape), smallest_size(bodies[b].shape));
    pairs.push_back({.a = a, .b = b, .size = size});
  });
  for (const RigidBody& body : bodies) balls.push_back(bounding_ball(body.shape));
}

std::vector<RigidPairs::Pair> RigidPairs::crossing(const std::vector<RigidBody>& bodies) {
  std::vector<Pair> found;
  for_each_pair(bodies, [&](std::size_t a, std::size_t b) {
    if (cross_paths(bodies[a], bodies[b])) found.emplace_back(bodies[a].name, bodies[b].name);
  });
  return found;
}

std::optional<RigidPairs::Pair> RigidPairs::overlapping(const std::vector<RigidBody>& bodies) {
  std::vector<Vec3> centres;
  for (std::size_t b = 0; b < bodies.size(); ++b) centres.push_back(bodies[b].in_space(balls[b].centre));
  for (Two& two : pairs) {
    const double reach = balls[two.a].radius + balls[two.b].radius;
    const Vec3 apart = centres[two.a] - centres[two.b];
    if (dot(apart, apart) > reach * reach) continue;
    const RigidBody &a = bodies[two.a], &b = bodies[two.b];
    if (two.of_a.empty() && two.of_b.empty()) {
      two.of_a = samples_for(a.shape, two.size, most_samples_along);
      two.of_b = samples_for(b.shape, two.size, most_samples_along);
      two.depth = touching_depth * two.size;
    }
    if (reaches_into(a, two.of_a, b, two.depth) || reaches_into(b, two.of_b, a, two.depth))
      return Pair{a.name, b.name};
  }
  return {};
}

} // namespace spall
