#pragma once

#include "macro/points/tensor.h"
#include "shared/input/parameters.h"

#include <algorithm>
#include <limits>

namespace spall {

/// What I1 means in Eqs. 22 to 24 and 30, tension positive.
enum class Invariant {
  mean_stress, ///< uniaxial compressive strength 45.7 MPa at 1e-3/s (nominal 38.2)
  trace        ///< 363 MPa: hence not the default
};

/// What C5 bounds.
enum class StrengthBound {
  equivalent_stress,    ///< the strength: the same in all directions
  principal_difference, ///< the largest principal stress difference: the equivalent stress of pure shear is
                        ///< sqrt(3) / 2 of it
  nothing
};

/// Which part of the failure surface the Lode effect reduces.
enum class LodeRange {
  everywhere, ///< the surface stays continuous at P = 0
  compression ///< Eq. 22 alone, as printed: in extension the strength jumps up where tension begins
};

/// Where a damage takes the cohesion C1 - C2: on the side of P = 0 that it belongs to (shear damage in
/// compression, tensile damage in tension), or on both.
enum class DamageSide { own, both };

/// Largest equivalent (von Mises) stress of concrete, against pressure, damage and strain rate (Eqs. 22, 23
/// and 30). Names as in Table 1, SI units.
struct FailureSurface {
  double C1 = required, C2 = required; ///< Pa
  double C3 = required, C4 = required; ///< 1
  double C5 = required;                ///< bound of the strength, Pa
  double A_N = required;               ///< 1/Pa
  Invariant invariant = Invariant::mean_stress;
  double rate_floor = 1e-3; ///< 1/s; keeps the logarithm of a point at rest finite
  StrengthBound bound = StrengthBound::equivalent_stress;
  double lode_eccentricity = 0.68; ///< strength in extension over compression at P = 0; 1: no Lode effect
  double lode_fading = 323e6;      ///< pressure where the eccentricity has risen to 1, Pa; 0: never
  LodeRange lode_range = LodeRange::everywhere;
  /// As Eqs. 22 and 30 are printed: d takes the cohesion on both sides, d_t takes the mean tension alone.
  DamageSide shear_damage_side = DamageSide::both, tensile_damage_side = DamageSide::own;

  /// -I1 of a pressure (both compression positive).
  double invariant_of(double pressure) const {
    return invariant == Invariant::mean_stress ? pressure : 3 * pressure;
  }

  /// Share of the cohesion C1 - C2 that the damages d and d_t have taken at a pressure.
  double lost_cohesion(double shear_damage, double tensile_damage, double pressure) const {
    const bool sheared = pressure >= 0 || shear_damage_side == DamageSide::both;
    const bool cracked = tensile_damage_side == DamageSide::both;
    return 1 - (1 - (sheared ? shear_damage : 0)) * (1 - (cracked ? tensile_damage : 0));
  }

  /// Factor of the effective deviatoric strain rate (1/s).
  double rate_factor(double rate) const { return 1 + C3 * std::log(std::max(rate, rate_floor)); }

  struct Strength {
    double stress;       ///< Pa
    double intact_share; ///< strength over that without damage: 1 where nothing is damaged
  };
  /// @param lost share of the cohesion that damage has taken (lost_cohesion): d of Eqs. 22 and 30
  /// @param tension largest mean tension, Pa: T_max (1 - d_t) of Eq. 30
  /// @param rate effective deviatoric strain rate, 1/s
  /// @param s deviator that is compared with the strength; only its direction matters, and only with the Lode
  ///   effect or with C5 on the principal difference
  Strength operator()(double pressure, double lost, double tension, double rate, const Sym3& s) const {
    Strength strength = pressure >= 0 ? compressive(pressure, lost) : tensile(pressure, lost, tension);
    if (lode_eccentricity < 1 && (pressure >= 0 || lode_range == LodeRange::everywhere))
      strength.stress *= lode_reduction(s, eccentricity(pressure));
    strength.stress = std::max(0.0, std::min(strength.stress * rate_factor(rate), largest(s)));
    return strength;
  }

  /// Strength in extension over compression at a pressure.
  double eccentricity(double pressure) const {
    if (!(lode_fading > 0)) return lode_eccentricity;
    return lode_eccentricity + (1 - lode_eccentricity) * std::clamp(pressure / lode_fading, 0.0, 1.0);
  }

  /// Radius of the deviatoric section of Willam and Warnke over that of triaxial compression, from the
  /// eccentricity e (extension) to 1 (compression).
  static double lode_reduction(const Sym3& s, double e) {
    if (!(contract(s, s) > 0)) return 1;
    const double c = cos_lode(s), a = 4 * (1 - e * e) * c * c, b = 2 * e - 1;
    return (2 * (1 - e * e) * c + b * std::sqrt(a + 5 * e * e - 4 * e)) / (a + b * b);
  }

  void declare(Parameters::Section& section);

private:
  double cohesion() const { return C1 - C2; } ///< strength at P = 0, where both surfaces meet, Pa
  /// Eq. 22 at rate 1/s.
  Strength compressive(double pressure, double lost) const {
    const double p = invariant_of(pressure), decay = std::exp(-A_N * p);
    const double intact = C1 - C2 * decay + C4 * p;
    const double stress = intact - cohesion() * lost * decay;
    return {stress, stress / intact};
  }
  /// Eqs. 23 and 30 at rate 1/s.
  Strength tensile(double pressure, double lost, double tension) const {
    const double p = invariant_of(pressure), share = 1 - lost;
    return {p > -tension ? cohesion() * share * (1 + p / tension) : 0, share};
  }
  /// Cosine of the Lode angle of a deviator: 1 in triaxial extension, 1/2 in triaxial compression.
  static double cos_lode(const Sym3& s) {
    const double j2 = contract(s, s) / 2;
    const double cos3 = 1.5 * std::sqrt(3.) * determinant(s) / (j2 * std::sqrt(j2));
    return std::cos(std::acos(std::clamp(cos3, -1.0, 1.0)) / 3);
  }
  /// The equivalent stress that C5 allows along a deviator: the principal stress difference is 2 / sqrt(3)
  /// sin(Lode angle + 60 degrees) times the equivalent stress.
  double largest(const Sym3& s) const {
    switch (bound) {
    case StrengthBound::nothing:
      return std::numeric_limits<double>::infinity();
    case StrengthBound::principal_difference:
      if (contract(s, s) > 0) {
        const double c = cos_lode(s);
        return C5 / ((std::sqrt(std::max(0.0, 1 - c * c)) + std::sqrt(3.) * c) / std::sqrt(3.));
      }
      [[fallthrough]];
    case StrengthBound::equivalent_stress:
      break;
    }
    return C5;
  }
};

} // namespace spall
