#pragma once

#include "macro/reinforcement/reinforcement.h"

namespace spall::test {

/// Of the bars, m, m^2, m^4.
inline constexpr double diameter = 10e-3, area = std::numbers::pi / 4 * diameter * diameter,
                        inertia = std::numbers::pi / 64 * diameter * diameter * diameter * diameter;

/// Reinforcing steel that hardens a little.
inline BarSteel steel(double rupture_strain = 10) {
  return {.youngs_modulus = 200e9,
          .yield_stress = 500e6,
          .hardening_modulus = 1e9,
          .rupture_strain = rupture_strain,
          .density = 7850};
}
inline BarSteel elastic_steel() {
  BarSteel s = steel();
  s.yield_stress = 1e30;
  return s;
}

/// Momenta about the origin.
struct MomentumSums {
  Vec3 linear{}, angular{};
  double size = 0, angular_size = 0; ///< sums of magnitudes

  void add(const Points& points, const VectorField& field, bool times_mass) {
    for (std::size_t i = 0; i < points.owned; ++i) {
      const Vec3 p = (times_mass ? points.mass[i] : 1) * field[i], turn = cross(points.position[i], p);
      linear += p, angular += turn;
      size += norm(p), angular_size += norm(turn);
    }
  }
};

} // namespace spall::test
