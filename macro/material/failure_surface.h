#pragma once

#include "macro/material/principal.h"
#include "shared/input/parameters.h"

#include <algorithm>

namespace spall {

/// What I1 means in Eqs. 22 to 24 and 30, tension positive.
enum class Invariant {
  mean_stress, ///< uniaxial compressive strength 45.7 MPa at 1e-3/s (nominal 38.2)
  trace        ///< 363 MPa: hence not the default
};

/// Largest equivalent (von Mises) stress of concrete, against pressure, shear damage and strain rate
/// (Eqs. 22, 23 and 30). Names as in Table 1, SI units.
struct FailureSurface {
  double C1 = required, C2 = required; ///< Pa
  double C3 = required, C4 = required; ///< 1
  double C5 = required;                ///< largest principal stress difference, Pa
  double A_N = required;               ///< 1/Pa
  double T_max = required;             ///< largest mean tension, Pa
  Invariant invariant = Invariant::mean_stress;
  double rate_floor = 1e-3;       ///< 1/s; keeps the logarithm of a point at rest finite
  double lode_eccentricity = 1;   ///< strength in extension over compression; 1: circle (no Lode effect)
  double tensile_rate_factor = 1; ///< on T_max and on the strain where tensile damage starts
  double table_strength = 1;      ///< on T_max: DamageLaw::strength_factor() of the damage table in use

  /// I1 of a pressure (compression positive) with the sign turned.
  double invariant_of(double pressure) const {
    return invariant == Invariant::mean_stress ? pressure : 3 * pressure;
  }

  /// The mean tension that can be carried at tensile damage d_t, Pa (Eq. 30).
  double tension_limit(double tensile_damage) const {
    return T_max * tensile_rate_factor * table_strength * (1 - tensile_damage);
  }

  /// Factor of the effective deviatoric strain rate (1/s).
  double rate_factor(double rate) const { return 1 + C3 * std::log(std::max(rate, rate_floor)); }

  struct Strength {
    double stress;       ///< Pa
    double intact_share; ///< strength over that without damage: 1 where nothing is damaged
  };
  /// `s` is the deviator that is compared with the strength (only its direction matters, and only if the Lode
  /// effect is on); `tension` is tension_limit().
  Strength operator()(double pressure, double shear_damage, double tension, double rate,
                      const Sym3& s) const {
    const double cohesion = C1 - C2; // of both surfaces at P = 0, so that they meet there
    const double p = invariant_of(pressure);
    double strength, share;
    if (pressure >= 0) { // Eq. 22
      const double decay = std::exp(-A_N * p);
      const double intact = C1 - C2 * decay + C4 * p;
      strength = intact - cohesion * shear_damage * decay;
      share = strength / intact;
      if (lode_eccentricity < 1) strength *= lode_reduction(s);
    } else { // Eqs. 23 and 30
      share = 1 - shear_damage;
      strength = p > -tension ? cohesion * share * (1 + p / tension) : 0;
    }
    return {std::max(0.0, std::min(strength * rate_factor(rate), C5)), share};
  }

  /// Radius of the deviatoric section of Willam and Warnke over that of triaxial compression, from
  /// lode_eccentricity (extension) to 1 (compression).
  double lode_reduction(const Sym3& s) const {
    const double j2 = contract(s, s) / 2;
    if (!(j2 > 0)) return 1;
    const double j3 = determinant(s);
    const double cos3 = 1.5 * std::sqrt(3.) * j3 / (j2 * std::sqrt(j2)); // 1 in triaxial extension
    const double c = std::cos(std::acos(std::clamp(cos3, -1.0, 1.0)) / 3);
    const double e = lode_eccentricity, a = 4 * (1 - e * e) * c * c, b = 2 * e - 1;
    return (2 * (1 - e * e) * c + b * std::sqrt(a + 5 * e * e - 4 * e)) / (a + b * b);
  }
};

} // namespace spall
