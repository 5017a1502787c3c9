#include "macro/contact/kernel_contact.h"

#include "macro/approximation/support.h"
#include "macro/points/parallel.h"

#include <algorithm>
#include <cmath>

namespace spall {
namespace {

constexpr std::size_t chunk_size = 32;

/// Computes the gradient B = A^-T C^-1 d_J phi_J of every point of a cloud in space.
void gradients(Cloud<double>& cloud, const Mat3& inverse_support, std::vector<Vec3>& b) {
  const Moments<double> m = evaluate_moments<Ball<CubicSpline>, false>(cloud);
  const Mat3& a = inverse_support;
  b.resize(cloud.size());
  for (std::size_t j = 0; j < cloud.size(); ++j) {
    const Vec3 g = times(m.inverse, Vec3{cloud.xi[0][j], cloud.xi[1][j], cloud.xi[2][j]} - m.mean);
    for (int c = 0; c < 3; ++c) b[j][c] = cloud.phi[j] * (a[c] * g[0] + a[3 + c] * g[1] + a[6 + c] * g[2]);
  }
}

} // namespace

SolidContactReport KernelContact::add_forces(const std::vector<ContactBody>& all_bodies, double dt) {
  zone.gather(all_bodies, pairs, margin);
  const std::vector<ContactBody>& bodies = zone.bodies();
  SolidContactReport report(bodies.size());
  remembered.resize(bodies.size());
  for (auto& of_body : remembered) of_body.resize(bodies.size());
  for (std::size_t own = 0; own < bodies.size(); ++own)
    for (std::size_t other = 0; other < bodies.size(); ++other)
      for (const ContactPair& pair : pairs)
        if ((pair.secondary == own && pair.primary == other) ||
            (pair.secondary == other && pair.primary == own))
          add_forces_at(bodies, own, other, dt, report);
  zone.give_back(all_bodies);
  if (report.touching == 0) return report;
  const ContactReport gap = surfaces.measure(bodies);
  report.touching = gap.touching, report.deepest = gap.deepest;
  report.gap_sum = gap.gap_sum, report.gap_max = gap.gap_max;
  return report;
}

std::vector<Vec3> KernelContact::recall(const std::vector<Traction>& kept, const ContactBody& body) {
  std::vector<Vec3> tractions(body.points->owned);
  auto next = kept.begin();
  for (std::size_t i = 0; i < tractions.size(); ++i) {
    while (next != kept.end() && next->number < body.number(i)) ++next;
    if (next != kept.end() && next->number == body.number(i)) tractions[i] = next->value;
  }
  return tractions;
}

std::vector<KernelContact::Traction> KernelContact::keep(const std::vector<Vec3>& tractions,
                                                         const ContactBody& body) {
  std::vector<Traction> kept;
  for (std::size_t i = 0; i < tractions.size(); ++i)
    if (tractions[i] != Vec3{}) kept.push_back({body.number(i), tractions[i]});
  return kept;
}

void KernelContact::add_forces_at(const std::vector<ContactBody>& bodies, std::size_t own, std::size_t other,
                                  double dt, SolidContactReport& report) {
  const ContactBody &self = bodies[own], &opposite = bodies[other];
  std::vector<Vec3> tractions = recall(remembered[own][other], self);
  remembered[own][other].clear();
  const double reach = margin * largest_spacing(*self.points);
  near_own.rebuild(self, box_of(*opposite.points, reach));
  near_other.rebuild(opposite, box_of(*self.points, 0.5 * reach));
  if (near_own.empty() || near_other.empty()) return;
  const auto velocity = [](const ContactBody& body, std::uint32_t i) {
    return body.ghosts->mirror(*body.points, i, body.points->velocity[body.ghosts->owner(*body.points, i)]);
  };
  const Points& points = *self.points;
  const auto& indices = near_own.indices();
  const std::size_t count = static_cast<std::size_t>(
      std::lower_bound(indices.begin(), indices.end(), static_cast<std::uint32_t>(points.owned)) -
      indices.begin());
  std::vector<Result> results(count);
  for_each_index((count + chunk_size - 1) / chunk_size, [&](std::size_t chunk) {
    thread_local Cloud<double> cloud, scratch;
    thread_local std::vector<Vec3> joint, alone;
    for (std::size_t n = chunk * chunk_size; n < std::min(count, (chunk + 1) * chunk_size); ++n) {
      const std::uint32_t j = indices[n];
      Vec3& t = tractions[j];
      const Support support =
          make_support(points.deformation(j), points.spacing[j],
                       {.normalized_size = contact_support, .max_stretch = largest_cell_stretch});
      const Vec3 x = points.position[j], half = support.half_widths(1);
      const double box = std::max({half[0], half[1], half[2]});
      const auto collect = [&](const NearPoints& near) {
        const Mat3& a = support.inverse;
        near.for_each(x, box, [&](std::uint32_t k, double dx, double dy, double dz) {
          const double u = a[0] * dx + a[1] * dy + a[2] * dz, v = a[3] * dx + a[4] * dy + a[5] * dz,
                       w = a[6] * dx + a[7] * dy + a[8] * dz;
          if (u * u + v * v + w * w < 1) cloud.add(near.indices()[k], u, v, w);
        });
      };
      cloud.clear();
      collect(near_other);
      const std::size_t others = cloud.size();
      if (others == 0) {
        t = {};
        continue;
      }
      cloud.clear();
      collect(near_own);
      const std::size_t owns = cloud.size();
      gradients(cloud, support.inverse, alone);
      collect(near_other);
      gradients(cloud, support.inverse, joint);
      for (std::size_t k = 0; k < owns; ++k) joint[k] -= alone[k];

      const Vec3 normal = contact_normal(x, near_own, near_other, box, inputs.normal, scratch);
      if (normal == Vec3{}) continue;
      // (i) strain increment from the motion of the other body, on the contact plane
      Vec3 along{}; // D n dt
      for (std::size_t k = 0; k < cloud.size(); ++k) {
        const Vec3 v = velocity(k < owns ? self : opposite, cloud.index[k]);
        const double bn = dot(joint[k], normal), vn = dot(v, normal);
        along += 0.5 * dt * (v * bn + joint[k] * vn);
      }
      const double strain = dot(along, normal);
      // (ii) elastic predictor (trial traction), split along the present normal
      const double before = dot(t, normal);
      const double stress = before + (self.bulk + 4. / 3 * self.shear) * strain;
      const Vec3 slip = along - strain * normal, old = t - before * normal;
      const Vec3 trial = old + 2 * self.shear * slip;
      if (!(stress < 0)) {
        t = {};
        continue; // contact has no tension: the bodies separate
      }
      // (iii) return mapping to the Coulomb cone, of stresses: impulses per area and time
      const double size = norm(trial), limit = inputs.friction.largest_impulse(-stress, 0, 1);
      const double return_factor = size > limit ? limit / size : 1;
      const Vec3 tangential = return_factor * trial;
      t = stress * normal + tangential;

      const double volume = points.volume[j] * determinant(points.deformation(j));
      Result& result = results[n];
      result.touching = true;
      result.normal_work = volume * 0.5 * (before + stress) * strain;
      for (int c = 0; c < 3; ++c) result.friction_work += volume * (old[c] + tangential[c]) * slip[c];
      for (std::size_t k = 0; k < cloud.size(); ++k) {
        const double bn = dot(joint[k], normal), bt = dot(joint[k], tangential);
        const Vec3 force = -volume * ((stress * normal + tangential) * bn + normal * bt);
        result.forces.push_back({cloud.index[k], k < owns, force});
      }
    }
  });
  remembered[own][other] = keep(tractions, self);
  // One thread adds in the order of the points, so that sums do not depend on the number of threads.
  for (const Result& result : results) {
    report.touching += result.touching;
    report.normal_loss += result.normal_work;
    report.friction_loss += result.friction_work;
    for (const Force& f : result.forces) {
      const ContactBody& body = f.own ? self : opposite;
      const std::uint32_t owner = body.ghosts->owner(*body.points, f.index);
      const Vec3 value = body.ghosts->mirror_back(*body.points, f.index, f.value);
      for (int c = 0; c < 3; ++c) body.points->force.component[c][owner] += value[c];
      (f.own ? report.exchange.given(other, own) : report.exchange.given(own, other)) += dt * value;
    }
  }
}

} // namespace spall
