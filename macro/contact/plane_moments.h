#pragma once

#include "macro/approximation/kernel.h"
#include "macro/points/points.h"

#include <cmath>
#include <utility>
#include <vector>

namespace spall {

/// Radius of a patch in extents of the deformed cells: a point of a lattice and its nearest neighbours.
inline constexpr double patch_radius = 1.5;

/// Two unit vectors that complete `normal` to a right-handed frame.
inline std::pair<Vec3, Vec3> tangents(const Vec3& n) {
  int least = 0;
  for (int c = 1; c < 3; ++c)
    if (std::abs(n[c]) < std::abs(n[least])) least = c;
  Vec3 u{};
  u[least] = 1;
  const double along = n[least];
  for (int c = 0; c < 3; ++c) u[c] -= along * n[c];
  const double length = std::sqrt(dot(u, u));
  for (double& x : u) x /= length;
  return {u, {n[1] * u[2] - n[2] * u[1], n[2] * u[0] - n[0] * u[2], n[0] * u[1] - n[1] * u[0]}};
}

/// Kernel-weighted moments in a tangent plane of points with coordinates `u`, `v`, a `distance` in extents of
/// cells and a `share`, which multiplies the kernel: mean and inverse second moment.
struct PlaneMoments {
  double sum = 0, mean_u = 0, mean_v = 0;
  double uu = 0, vv = 0, uv = 0; ///< components of the inverse second moment
  bool linear = false;           ///< whether the origin is among the points: no extrapolation to it

  template<class Candidate> explicit PlaneMoments(const std::vector<Candidate>& candidates) {
    for (const Candidate& c : candidates) {
      const double phi = kernel(c);
      sum += phi, mean_u += phi * c.u, mean_v += phi * c.v;
    }
    mean_u /= sum, mean_v /= sum;
    double a = 0, b = 0, ab = 0;
    for (const Candidate& c : candidates) {
      const double phi = kernel(c), u = c.u - mean_u, v = c.v - mean_v;
      a += phi * u * u, b += phi * v * v, ab += phi * u * v;
    }
    const double determinant = a * b - ab * ab;
    // On a line they have no slope across it.
    if (determinant > 0.01 * a * b) uu = b / determinant, vv = a / determinant, uv = -ab / determinant;
    // Within a standard deviation of the mean: nowhere do the weights extrapolate far.
    linear = sum * (uu * mean_u * mean_u + 2 * uv * mean_u * mean_v + vv * mean_v * mean_v) < 1;
  }
  template<class Candidate> static double kernel(const Candidate& c) {
    return c.share * CubicSpline::value(c.distance / patch_radius);
  }
  /// Kernel times the gradient of a linear fit: the slope is the sum of these times the values.
  template<class Candidate> std::pair<double, double> slopes(const Candidate& c) const {
    const double phi = kernel(c), u = c.u - mean_u, v = c.v - mean_v;
    return {phi * (uu * u + uv * v), phi * (uv * u + vv * v)};
  }
  /// Weights of a value at the origin; they add up to one and reproduce linear fields.
  template<class Candidate> double weight(const Candidate& c) const {
    const auto [gu, gv] = slopes(c);
    return kernel(c) / sum - (linear ? gu * mean_u + gv * mean_v : 0);
  }
};

} // namespace spall
