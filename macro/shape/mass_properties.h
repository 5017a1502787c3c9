#pragma once

#include "macro/points/quaternion.h"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace spall {

/// Mass properties of a homogeneous body.
struct MassProperties {
  double volume = 0; ///< m^3
  Vec3 centre{};     ///< of mass, m
  Vec3 moments{};    ///< of inertia about the principal axes through the centre of mass, per mass, m^2
  Quaternion axes{}; ///< turns x, y, z into the principal axes
};

/// What is left of a body after a part of it was taken out (parallel axis theorem). Both have their centres
/// of mass and one principal axis on the z axis.
inline MassProperties without(const MassProperties& whole, const MassProperties& part) {
  MassProperties rest;
  rest.volume = whole.volume - part.volume;
  rest.centre = 1 / rest.volume * (whole.volume * whole.centre - part.volume * part.centre);
  const auto square = [](double a) { return a * a; };
  for (int c = 0; c < 3; ++c) {
    const auto about_rest = [&](const MassProperties& p) {
      return p.volume * (p.moments[c] + (c < 2 ? square(p.centre[2] - rest.centre[2]) : 0));
    };
    rest.moments[c] = (about_rest(whole) - about_rest(part)) / rest.volume;
  }
  return rest;
}

/// A body of revolution about z, by Gauss quadrature between the places where the radius or its slope jumps,
/// which are given in ascending order. Its accuracy is that of round-off for a tangent ogive.
/// @param radius of the section at z, m
template<class Radius> MassProperties revolve(const Radius& radius, const std::vector<double>& breaks) {
  constexpr std::array<double, 5> place = {-0.906179845938664, -0.538469310105683, 0, 0.538469310105683,
                                           0.906179845938664};
  constexpr std::array<double, 5> weight = {0.236926885056189, 0.478628670499366, 0.568888888888889,
                                            0.478628670499366, 0.236926885056189};
  constexpr int intervals = 16;
  double area = 0, first = 0, second = 0, quartic = 0; // integrals of r^2, r^2 z, r^2 z^2, r^4
  for (std::size_t k = 0; k + 1 < breaks.size(); ++k)
    for (int n = 0; n < intervals; ++n) {
      const double half = 0.5 * (breaks[k + 1] - breaks[k]) / intervals,
                   middle = breaks[k] + (2 * n + 1) * half;
      for (std::size_t g = 0; g < place.size(); ++g) {
        const double z = middle + half * place[g], r = radius(z), r2 = r * r, w = half * weight[g];
        area += w * r2, first += w * r2 * z, second += w * r2 * z * z, quartic += w * r2 * r2;
      }
    }
  MassProperties p;
  p.volume = std::numbers::pi * area;
  p.centre = {0, 0, first / area};
  const double axial = 0.5 * quartic / area;
  const double transverse = 0.5 * axial + second / area - p.centre[2] * p.centre[2];
  p.moments = {transverse, transverse, axial};
  return p;
}

} // namespace spall
