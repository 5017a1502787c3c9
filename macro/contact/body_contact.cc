#include "macro/contact/body_contact.h"

#include "macro/contact/carried_surface.h"
#include "macro/contact/plane_moments.h"
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

/// Radius of the kernel that spreads the force of a point over a carried surface, in the point's spacings: 1
/// gives the kernel the second moment of the point's cell. Half of it drives the tip of a steel projectile
/// into its nose when the concrete's points are as far apart as the nose is thick.
constexpr double loaded_part = 1;

} // namespace

BodyContactReport BodyContact::apply(const std::vector<ContactBody>& bodies, double dt, double kick) {
  BodyContactReport report;
  report.impulse.resize(bodies.size());
  report.from_first.resize(bodies.size());
  last.swap(touches);
  find_touches(bodies, dt, watched_gap);
  if (touches.empty()) return report;
  ImpulseSystem system = gather_system(touches, bodies);
  solve_impulses(touches, system, inputs.friction);
  apply_system(system, bodies);

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
    const auto book = [&](std::size_t body, double sign) {
      report.impulse[body] = add(report.impulse[body], sign, touch.impulse);
    };
    book(touch.slave_body, 1), book(touch.master_body, -1);
    if (touch.slave_body == 0) {
      Vec3& given = report.from_first[touch.master_body];
      given = add(given, -1, touch.impulse);
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
  for (std::size_t slave = 0; slave < bodies.size(); ++slave)
    for (std::size_t master = slave + 1; master < bodies.size(); ++master)
      find_touches(bodies, slave, master, dt, watched);
}

double BodyContact::look_at_carried(Touch& touch, const std::vector<ContactBody>& bodies, std::uint32_t n,
                                    double watched) const {
  const ContactBody& body = bodies[touch.master_body];
  const Vec3 x = bodies[touch.slave_body].points->position[touch.slave];
  const double h = near_slave.spacing(n), offset = inputs.stand_off * h, load = loaded_part * h;
  const double reach = offset + watched * h + std::max(patch_radius * near_master.largest_spacing(), load);
  if (!find_carried_patch(touch.patch, x, body, near_master, load, reach)) return 0;
  touch.patch.gap -= offset;
  return std::max(h, near_master.largest_spacing());
}

double BodyContact::look_at_fitted(Touch& touch, const std::vector<ContactBody>& bodies, std::uint32_t n,
                                   double watched) const {
  const Points &own = *bodies[touch.slave_body].points, &other = *bodies[touch.master_body].points;
  const Vec3 x = own.position[touch.slave];
  // A point is above the cell of one of the other's points, or far from all of them.
  const double across = facing_radius * near_master.largest_extent();
  const double largest = std::max(near_slave.spacing(n), near_master.largest_spacing());
  const double above = watched * largest + own.surface_offset * near_slave.largest_extent() +
                       other.surface_offset * near_master.largest_extent();
  const double far = std::sqrt(across * across + above * above);
  double nearest = far * far, facing = 0; // the spacing may change along the master's surface
  near_master.for_each(x, far, [&](std::uint32_t k, double dx, double dy, double dz) {
    const double square = dx * dx + dy * dy + dz * dz;
    if (square < nearest) nearest = square, facing = near_master.spacing(k);
  });
  if (!(facing > 0)) return 0;
  const double spacing = std::max(near_slave.spacing(n), facing);
  const Vec3 start = separating_direction(x, near_slave, near_master, contact_support * spacing);
  if (start == Vec3{} || !find_patch(touch.patch, x, near_master, other.surface_offset, start)) return 0;
  touch.patch.gap -= own.surface_offset * near_slave.extent_along(n, touch.patch.normal);
  return is_hidden(near_slave, n, x, touch.patch.normal) ? 0 : spacing;
}

void BodyContact::find_touches(const std::vector<ContactBody>& bodies, std::size_t slave, std::size_t master,
                               double dt, double watched) {
  const Points &own = *bodies[slave].points, &other = *bodies[master].points;
  if (own.owned == 0 || other.owned == 0) return;
  const double around = margin * std::max(largest_spacing(own), largest_spacing(other));
  near_slave.rebuild(bodies[slave], box_of(other, around));
  if (near_slave.empty()) return;
  near_master.rebuild(bodies[master], box_of(own, around));
  if (near_master.empty()) return;

  const bool carried = inputs.surface == ContactSurface::known && bodies[master].surface;
  const auto& indices = near_slave.indices();
  const std::size_t count =
      std::lower_bound(indices.begin(), indices.end(), static_cast<std::uint32_t>(own.owned)) -
      indices.begin();
  std::vector<std::vector<Touch>> parts((count + chunk_size - 1) / chunk_size);
  for_each_index(parts.size(), [&](std::size_t p) {
    Touch touch{.slave_body = slave, .master_body = master};
    for (std::size_t k = p * chunk_size; k < std::min(count, (p + 1) * chunk_size); ++k) {
      const auto n = static_cast<std::uint32_t>(k);
      touch.slave = indices[n];
      touch.number = bodies[slave].number(touch.slave);
      const double spacing =
          carried ? look_at_carried(touch, bodies, n, watched) : look_at_fitted(touch, bodies, n, watched);
      if (!(spacing > 0)) continue;
      const double gap = touch.patch.gap;
      const Vec3 motion = relative(
          touch, bodies, [&](std::size_t b, std::uint32_t i) { return bodies[b].points->velocity[i]; });
      if (gap + dt * std::min(dot(motion, touch.patch.normal), 0.0) > watched * spacing) continue;
      touch.target = dt > 0 ? inputs.target_velocity(gap, dt) : 0;
      touch.impulse = {};
      parts[p].push_back(touch);
    }
  });
  // The last step's impulses, along today's normals, are where the iteration starts. Both lists are ordered.
  auto old = last.begin();
  const auto before = [](const Touch& a, const Touch& b) {
    return std::tie(a.slave_body, a.master_body, a.number) < std::tie(b.slave_body, b.master_body, b.number);
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
