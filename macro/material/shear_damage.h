#pragma once

#include "macro/points/lane_math.h"
#include "shared/input/parameters.h"

#include <algorithm>

namespace spall {

/// Shear damage d of concrete, 0 to 1 (Eq. 24): plastic strain over the strain to failure, and crushing over
/// one and a half times the locking strain. SI units. V: one point or several (lane_math.h).
struct ShearDamage {
  bool active = true;
  double D1 = required; ///< strain to failure per pressure, 1/Pa
  /// The strain to failure of Eq. 24 belongs to points this far apart, m. At another spacing h it is
  /// multiplied by reference / h, so that a shear band one spacing wide dissipates the same per area at any
  /// spacing (crack band: Bazant and Oh 1983). 0: the same strain at any spacing.
  double reference = 0.1;
  /// Smallest strain to failure. Eq. 24 as printed (0) divides by a pressure that vanishes and fails the
  /// point at its first plastic step in tension; 0.01 is EFmin of Holmquist, Johnson and Cook's concrete.
  double floor = 0.01;

  /// Plastic strain to failure at -I1 (Pa) for points `spacing` apart (m). At spacing 0, a point that is
  /// driven alone, the strain is not scaled.
  template<class V> V failure_strain(const V& invariant, double spacing) const {
    return larger(floor, V(D1 * invariant)) * (reference > 0 && spacing > 0 ? reference / spacing : 1);
  }
  /// First term of Eq. 24: adds a plastic strain.
  template<class V>
  void add_flow(V& damage, const V& plastic_strain, const V& invariant, double spacing) const {
    if (active)
      damage += select(plastic_strain > 0., V(plastic_strain / failure_strain(invariant, spacing)), 0);
  }
  /// Second term of Eq. 24, and its bound: adds a plastic volumetric strain (compression positive).
  template<class V> void add_crushing(V& damage, const V& plastic_volume, double C9) const {
    if (active) damage = smaller(1, V(damage + plastic_volume / (1.5 * C9)));
  }

  void declare(Parameters::Section& section);
};

} // namespace spall
