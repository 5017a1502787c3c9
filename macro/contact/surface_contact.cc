#include "macro/contact/surface_contact.h"

#include "macro/contact/carried_surface.h"
#include "macro/contact/facing_patch.h"
#include "macro/contact/plane_moments.h"
#include "macro/points/parallel.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace spall {
namespace {

constexpr std::size_t chunk_size = 32;

/// Touches with a gap below this fraction of a spacing are passed to the solver even if they would stay open,
/// because impulses on their neighbours may close them.
constexpr double watched_gap = 0.05;

/// Radius of the kernel that distributes the force of a point over a carried surface, in spacings of the
/// point: with 1 the kernel has the second moment of the point's cell. With half of it, forces are so
/// concentrated that the tip of a steel projectile is pushed into its nose if the concrete's spacing is as
/// large as the thickness of the nose.
constexpr double loaded_part = 1;

} // namespace

SolidContactReport SurfaceContact::apply_impulses(const std::vector<ContactBody>& bodies, double dt,
                                                  double kick) {
  zone.gather(bodies, pairs, margin);
  SolidContactReport report = touch(zone.bodies(), dt, kick);
  zone.give_back(bodies);
  return report;
}

SolidContactReport SurfaceContact::touch(const std::vector<ContactBody>& bodies, double dt, double kick) {
  SolidContactReport report(bodies.size());
  last.swap(touches);
  find_touches(bodies, dt, watched_gap);
  if (touches.empty()) return report;
  ImpulseSystem system = gather_system(touches, bodies);
  solve_impulses(touches, system, inputs.friction);
  apply_system(system, bodies);
  for (const Touch& touch : touches) book(touch, bodies, kick, report);
  return report;
}

void SurfaceContact::book(const Touch& touch, const std::vector<ContactBody>& bodies, double kick,
                          SolidContactReport& report) const {
  report.deepest = std::max(report.deepest, -touch.patch.gap);
  const double normal = dot(touch.impulse, touch.patch.normal);
  if (!(normal > 0)) return;
  // The impulse acts together with the internal force, so its work is the product with the mean of the
  // velocities before both and after both.
  const Vec3 after =
      relative(touch, bodies, [&](std::size_t b, std::uint32_t i) { return bodies[b].points->velocity[i]; });
  const Vec3 kicks = relative(touch, bodies, [&](std::size_t b, std::uint32_t i) {
    return kick / bodies[b].points->mass[i] * bodies[b].points->force[i];
  });
  const Vec3 mean = 0.5 * (touch.before - kicks + after);
  const double all = -dot(touch.impulse, mean), along = -normal * dot(touch.patch.normal, mean);
  report.normal_loss += along;
  report.friction_loss += all - along;
  report.exchange.given(touch.primary_body, touch.secondary_body) += touch.impulse;
  report.exchange.given(touch.secondary_body, touch.primary_body) -= touch.impulse;
  report.count_gap(touch.patch.gap);
}

ContactReport SurfaceContact::measure(const std::vector<ContactBody>& bodies) {
  ContactReport report;
  find_touches(bodies, 0, 1);
  for (const Touch& touch : touches) {
    report.count_gap(touch.patch.gap);
    report.deepest = std::max(report.deepest, -touch.patch.gap);
  }
  return report;
}

void SurfaceContact::find_touches(const std::vector<ContactBody>& bodies, double dt, double watched) {
  touches.clear();
  for (const ContactPair& pair : pairs) find_touches(bodies, pair, dt, watched);
}

double SurfaceContact::look_at_carried(Touch& touch, const std::vector<ContactBody>& bodies, std::uint32_t n,
                                       double watched) const {
  const ContactBody& body = bodies[touch.primary_body];
  const Points& own = *bodies[touch.secondary_body].points;
  const double h = near_secondary.spacing(n), load = loaded_part * h;
  const double reach = own.surface_offset * near_secondary.largest_extent() + watched * h +
                       std::max(patch_radius * near_primary.largest_spacing(), load);
  if (!find_carried_patch(touch.patch, own.position[touch.secondary], body, near_primary, load, reach))
    return 0;
  touch.patch.gap -= own.surface_offset * near_secondary.extent_along(n, touch.patch.normal);
  return std::max(h, near_primary.largest_spacing());
}

void SurfaceContact::find_touches(const std::vector<ContactBody>& bodies, const ContactPair& pair, double dt,
                                  double watched) {
  const ContactBody &secondary = bodies[pair.secondary], &primary = bodies[pair.primary];
  const Points &own = *secondary.points, &other = *primary.points;
  if (own.owned == 0 || other.owned == 0) return;
  const double around = margin * std::max(largest_spacing(own), largest_spacing(other));
  near_secondary.rebuild(secondary, box_of(other, around));
  if (near_secondary.empty()) return;
  near_primary.rebuild(primary, box_of(own, around));
  if (near_primary.empty()) return;

  const bool carried = inputs.surface == ContactSurface::known && primary.surface;
  const auto& indices = near_secondary.indices();
  const std::size_t count =
      std::lower_bound(indices.begin(), indices.end(), static_cast<std::uint32_t>(own.owned)) -
      indices.begin();
  std::vector<std::vector<Touch>> parts((count + chunk_size - 1) / chunk_size);
  for_each_index(parts.size(), [&](std::size_t p) {
    Touch touch{.secondary_body = pair.secondary, .primary_body = pair.primary};
    for (std::size_t k = p * chunk_size; k < std::min(count, (p + 1) * chunk_size); ++k) {
      const auto n = static_cast<std::uint32_t>(k);
      touch.secondary = indices[n];
      touch.number = secondary.number(touch.secondary);
      const double spacing =
          carried ? look_at_carried(touch, bodies, n, watched)
                  : find_facing_patch(touch.patch, own, near_secondary, n, other, near_primary, watched);
      if (!(spacing > 0)) continue;
      const double gap = touch.patch.gap;
      const Vec3 motion = relative(
          touch, bodies, [&](std::size_t b, std::uint32_t i) { return bodies[b].points->velocity[i]; });
      if (gap + dt * std::min(dot(motion, touch.patch.normal), 0.0) > watched * spacing) continue;
      touch.target = dt > 0 ? inputs.target_velocity(gap, dt) : 0;
      touch.impulse = {};
      if (inputs.friction.is_limited())
        touch.face_dt = dt * own.face_area(touch.secondary, touch.patch.normal);
      parts[p].push_back(touch);
    }
  });
  append(parts);
}

void SurfaceContact::append(std::vector<std::vector<Touch>>& parts) {
  auto old = last.begin(); // both lists are sorted
  const auto before = [](const Touch& a, const Touch& b) {
    return std::tie(a.secondary_body, a.primary_body, a.number) <
           std::tie(b.secondary_body, b.primary_body, b.number);
  };
  for (auto& part : parts)
    for (Touch& touch : part) {
      old = std::lower_bound(old, last.end(), touch, before);
      if (old != last.end() && !before(touch, *old))
        touch.impulse = std::max(0.0, dot(old->impulse, touch.patch.normal)) * touch.patch.normal;
      touches.push_back(std::move(touch));
    }
}

} // namespace spall
