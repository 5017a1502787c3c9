#include "macro/contact/impulses.h"

#include <algorithm>
#include <cmath>

namespace spall {
namespace {

Vec3 velocity(const Touch& touch, const std::vector<ContactBody>& bodies) {
  return relative(touch, bodies,
                  [&](std::size_t b, std::uint32_t i) { return bodies[b].points->velocity[i]; });
}

/// Gives the slave an impulse and takes it from the master.
void exchange(const Touch& touch, const std::vector<ContactBody>& bodies, const Vec3& impulse) {
  const auto add = [](Points& points, std::uint32_t i, double factor, const Vec3& a) {
    for (int c = 0; c < 3; ++c) points.velocity.component[c][i] += factor / points.mass[i] * a[c];
  };
  add(*bodies[touch.slave_body].points, touch.slave, 1, impulse);
  Points& master = *bodies[touch.master_body].points;
  const Ghosts& ghosts = *bodies[touch.master_body].ghosts;
  for (const PatchPoint& p : touch.patch.points)
    add(master, ghosts.owner(master, p.index), -p.weight, ghosts.mirror_back(master, p.index, impulse));
}

/// Relative velocity along the normal per impulse along it, and a bound of the tangential one. An owner may
/// be in the patch several times, with its images.
void set_mobilities(Touch& touch, const std::vector<ContactBody>& bodies) {
  const Points& master = *bodies[touch.master_body].points;
  const Ghosts& ghosts = *bodies[touch.master_body].ghosts;
  const auto& patch = touch.patch.points;
  touch.normal_mobility = touch.tangent_mobility = 1 / bodies[touch.slave_body].points->mass[touch.slave];
  for (const PatchPoint& p : patch) {
    const std::uint32_t owner = ghosts.owner(master, p.index);
    const Vec3 n = ghosts.mirror_back(master, p.index, touch.patch.normal);
    for (const PatchPoint& q : patch) {
      if (ghosts.owner(master, q.index) != owner) continue;
      const double product = p.weight * q.weight / master.mass[owner];
      touch.normal_mobility += product * dot(n, ghosts.mirror_back(master, q.index, touch.patch.normal));
      touch.tangent_mobility += std::abs(product);
    }
  }
}

} // namespace

void solve_impulses(std::vector<Touch>& touches, const std::vector<ContactBody>& bodies, double friction) {
  double largest = 0;
  for (Touch& touch : touches) {
    set_mobilities(touch, bodies);
    touch.before = velocity(touch, bodies);
    largest = std::max(largest, touch.target - dot(touch.before, touch.patch.normal));
  }
  // The impulses of the last step are a good guess: a body at rest on another needs no sweeps.
  for (const Touch& touch : touches) exchange(touch, bodies, touch.impulse);
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    double change = 0;
    for (Touch& touch : touches) {
      const Vec3& n = touch.patch.normal;
      const Vec3 v = velocity(touch, bodies);
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
      exchange(touch, bodies, step);
      change = std::max(change, std::sqrt(dot(step, step)) * touch.normal_mobility);
    }
    if (change <= sweep_tolerance * largest) break;
  }
}

} // namespace spall
