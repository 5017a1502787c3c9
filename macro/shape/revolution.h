#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace spall {

/// Of a homogeneous body of revolution about z. Moments of inertia are per mass, m^2.
struct MassProperties {
  double volume = 0; ///< m^3
  double centre = 0; ///< z of the centre of mass, m
  double axial = 0;
  double transverse = 0; ///< about an axis across through the centre of mass
};

/// By Gauss quadrature between the places where the profile has kinks, which are given in ascending order.
/// Its accuracy is that of round-off for a tangent ogive. @param radius of the section at z, m
template<class Radius> MassProperties revolve(const Radius& radius, const std::vector<double>& kinks) {
  constexpr std::array<double, 5> place = {-0.906179845938664, -0.538469310105683, 0, 0.538469310105683,
                                           0.906179845938664};
  constexpr std::array<double, 5> weight = {0.236926885056189, 0.478628670499366, 0.568888888888889,
                                            0.478628670499366, 0.236926885056189};
  constexpr int intervals = 16;
  double area = 0, first = 0, second = 0, quartic = 0; // integrals of r^2, r^2 z, r^2 z^2, r^4
  for (std::size_t k = 0; k + 1 < kinks.size(); ++k)
    for (int n = 0; n < intervals; ++n) {
      const double half = 0.5 * (kinks[k + 1] - kinks[k]) / intervals, middle = kinks[k] + (2 * n + 1) * half;
      for (std::size_t g = 0; g < place.size(); ++g) {
        const double z = middle + half * place[g], r = radius(z), r2 = r * r, w = half * weight[g];
        area += w * r2, first += w * r2 * z, second += w * r2 * z * z, quartic += w * r2 * r2;
      }
    }
  MassProperties p;
  p.volume = std::numbers::pi * area;
  p.centre = first / area;
  p.axial = 0.5 * quartic / area;
  p.transverse = 0.5 * p.axial + second / area - p.centre * p.centre;
  return p;
}

} // namespace spall
