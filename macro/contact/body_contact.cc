#include "macro/contact/body_contact.h"

#include "macro/contact/contact_normal.h"
#include "macro/points/parallel.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace spall {
namespace {

constexpr std::size_t chunk_size = 32;

/// Touches whose gap is below this part of a spacing are given to the solver even if they stay open by
/// themselves: impulses on their neighbours may close them.
constexpr double watched_gap = 0.05;

} // namespace

BodyContactReport BodyContact::apply(const std::vector<ContactBody>& bodies, double dt, double kick) {
  BodyContactReport report;
  report.impulse.resize(bodies.size());
  last.swap(touches);
  find_touches(bodies, dt, watched_gap);
  if (touches.empty()) return report;
  solve_impulses(touches, bodies, inputs.friction);

  const auto motion = [&](std::size_t b, std::uint32_t i) { return bodies[b].points->velocity[i]; };
  const auto kicked = [&](std::size_t b, std::uint32_t i) {
    Vec3 a = bodies[b].points->force[i];
    for (double& x : a) x *= kick / bodies[b].points->mass[i];
    return a;
  };
  for (const Touch& touch : touches) {
    report.deepest = std::max(report.deepest, -touch.patch.gap);
    const double normal = dot(touch.impulse, touch.patch.normal);
    if (!(normal > 0)) continue;
    // The impulse acts together with the internal force: it works on the mean of the velocities before both
    // and after both.
    const Vec3 after = relative(touch, bodies, motion), kicks = relative(touch, bodies, kicked);
    Vec3 mean;
    for (int c = 0; c < 3; ++c) mean[c] = 0.5 * (touch.before[c] - kicks[c] + after[c]);
    const double all = -dot(touch.impulse, mean), along = -normal * dot(touch.patch.normal, mean);
    report.normal_loss += along;
    report.friction_loss += all - along;
    for (int c = 0; c < 3; ++c) {
      report.impulse[touch.slave_body][c] += touch.impulse[c];
      report.impulse[touch.master_body][c] -= touch.impulse[c];
    }
    ++report.touching;
    report.gap_sum += std::abs(touch.patch.gap);
    report.gap_max = std::max(report.gap_max, std::abs(touch.patch.gap));
  }
  return report;
}

BodyContactReport BodyContact::measure(const std::vector<ContactBody>& bodies) {
  BodyContactReport report;
  find_touches(bodies, 0, 1);
  for (const Touch& touch : touches) {
    ++report.touching;
    report.gap_sum += std::abs(touch.patch.gap);
    report.gap_max = std::max(report.gap_max, std::abs(touch.patch.gap));
    report.deepest = std::max(report.deepest, -touch.patch.gap);
  }
  return report;
}

void BodyContact::find_touches(const std::vector<ContactBody>& bodies, double dt, double watched) {
  touches.clear();
  for (std::size_t a = 0; a < bodies.size(); ++a)
    for (std::size_t b = a + 1; b < bodies.size(); ++b) {
      const bool first = bodies[a].points->spacing.front() <= bodies[b].points->spacing.front();
      find_touches(bodies, first ? a : b, first ? b : a, dt, watched);
    }
}

void BodyContact::find_touches(const std::vector<ContactBody>& bodies, std::size_t slave, std::size_t master,
                               double dt, double watched_spacings) {
  const Points &own = *bodies[slave].points, &other = *bodies[master].points;
  const double radius = contact_support * std::max(own.spacing.front(), other.spacing.front());
  near_slave.rebuild(bodies[slave], box_of(other, radius));
  if (near_slave.empty()) return;
  near_master.rebuild(bodies[master], box_of(own, radius));
  if (near_master.empty()) return;

  const double watched = watched_spacings * std::max(own.spacing.front(), other.spacing.front());
  // A point is above the cell of one of the other's points, or far from all of them.
  const double across = facing_radius * near_master.largest_extent();
  const double above = watched + own.surface_offset * near_slave.largest_extent() +
                       other.surface_offset * near_master.largest_extent();
  const double far = std::sqrt(across * across + above * above);
  const double own_cell = std::pow(own.spacing.front(), 3), other_cell = std::pow(other.spacing.front(), 3);
  const auto& indices = near_slave.indices();
  const std::size_t count =
      std::lower_bound(indices.begin(), indices.end(), static_cast<std::uint32_t>(own.owned)) -
      indices.begin();
  std::vector<std::vector<Touch>> parts((count + chunk_size - 1) / chunk_size);
  for_each_index(parts.size(), [&](std::size_t p) {
    Touch touch{.slave_body = slave, .master_body = master};
    for (std::size_t n = p * chunk_size; n < std::min(count, (p + 1) * chunk_size); ++n) {
      const std::uint32_t i = indices[n];
      const Vec3 x = own.position[i];
      bool near = false;
      near_master.for_each(x, far, [&](std::uint32_t, double dx, double dy, double dz) {
        near = near || dx * dx + dy * dy + dz * dz < far * far;
      });
      if (!near) continue;
      const Vec3 start = separating_direction(x, near_slave, near_master, radius, own_cell, other_cell);
      if (start == Vec3{} || !find_patch(touch.patch, x, near_master, other.surface_offset, start)) continue;
      const Vec3& normal = touch.patch.normal;
      touch.slave = i;
      touch.patch.gap -= own.surface_offset * near_slave.extent_along(static_cast<std::uint32_t>(n), normal);
      const double gap = touch.patch.gap;
      const Vec3 motion = relative(
          touch, bodies, [&](std::size_t b, std::uint32_t k) { return bodies[b].points->velocity[k]; });
      if (gap + dt * std::min(dot(motion, normal), 0.0) > watched) continue;
      if (is_hidden(near_slave, static_cast<std::uint32_t>(n), x, normal)) continue;
      // Ends the step with a closed gap, or takes back part of an older overlap.
      touch.target = dt > 0 ? (gap >= 0 ? -1 : -inputs.overlap_release) * gap / dt : 0;
      touch.impulse = {};
      parts[p].push_back(touch);
    }
  });
  // The last step's impulses, along today's normals, are where the iteration starts. Both lists are ordered.
  auto old = last.begin();
  const auto before = [](const Touch& a, const Touch& b) {
    return std::tie(a.slave_body, a.master_body, a.slave) < std::tie(b.slave_body, b.master_body, b.slave);
  };
  for (auto& part : parts)
    for (Touch& touch : part) {
      old = std::lower_bound(last.begin(), last.end(), touch, before);
      if (old != last.end() && !before(touch, *old)) {
        const double normal = std::max(0.0, dot(old->impulse, touch.patch.normal));
        for (int c = 0; c < 3; ++c) touch.impulse[c] = normal * touch.patch.normal[c];
      }
      touches.push_back(std::move(touch));
    }
}

} // namespace spall
