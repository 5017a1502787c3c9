#include "macro/contact/contact_normal.h"

#include <cmath>

namespace spall {
namespace {

Vec3 unit_or_zero(const Vec3& a) {
  const double length = std::sqrt(dot(a, a));
  return length > 0 ? Vec3{a[0] / length, a[1] / length, a[2] / length} : Vec3{};
}

} // namespace

Vec3 contact_normal(const Vec3& x, const NearPoints& own, const NearPoints& other, double radius,
                    ContactNormal kind, Cloud<double>& cloud) {
  const double scale = 1 / radius;
  cloud.clear();
  const auto collect = [&](std::uint32_t j, double dx, double dy, double dz) {
    if (dx * dx + dy * dy + dz * dz < radius * radius) cloud.add(j, dx * scale, dy * scale, dz * scale);
  };
  other.for_each(x, radius, collect);
  const std::size_t others = cloud.size();
  if (others == 0) return {};
  if (kind == ContactNormal::pair) {
    Vec3 sum{};
    for (std::size_t j = 0; j < others; ++j) {
      const Vec3 d = {cloud.xi[0][j], cloud.xi[1][j], cloud.xi[2][j]};
      const double distance = std::sqrt(dot(d, d));
      if (!(distance > 0)) continue;
      const double weight = CubicSpline::value(distance) / distance;
      for (int c = 0; c < 3; ++c) sum[c] -= weight * d[c];
    }
    return unit_or_zero(sum);
  }
  own.for_each(x, radius, collect);
  const Moments<double> m = evaluate_moments<Ball<CubicSpline>, false>(cloud);
  if (!(m.mu0 > 0)) return {};
  // The sum of Eq. 18: B_J = C^-1 d_J phi_J times C_J.
  Vec3 sum{};
  for (std::size_t j = 0; j < cloud.size(); ++j) {
    const double value = (j < others ? -1 : 1) * cloud.phi[j];
    for (int c = 0; c < 3; ++c) sum[c] += value * (cloud.xi[c][j] - m.mean[c]);
  }
  return unit_or_zero(times(m.inverse, sum));
}

Vec3 separating_direction(const Vec3& x, const NearPoints& own, const NearPoints& other, double radius) {
  const auto gradient = [&](const NearPoints& near) {
    Vec3 sum{};
    near.for_each(x, radius, [&](std::uint32_t n, double dx, double dy, double dz) {
      const double r = std::sqrt(dx * dx + dy * dy + dz * dz) / radius;
      if (r >= 1) return;
      const double h = near.spacing(n), slope = h * h * h * CubicSpline::slope_over_radius(r);
      sum[0] -= slope * dx, sum[1] -= slope * dy, sum[2] -= slope * dz;
    });
    return sum;
  };
  const Vec3 a = gradient(own), b = gradient(other);
  if (b == Vec3{}) return {};
  return unit_or_zero({a[0] - b[0], a[1] - b[1], a[2] - b[2]});
}

} // namespace spall
