#pragma once

#include "macro/points/lane_math.h"
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

/// Which tension T_max (1 - d_t) of Eqs. 23 and 30 limits.
enum class TensionLimit {
  mean_stress, ///< the mean alone, as printed: uniaxial strength 5.0 MPa, biaxial 3.2 MPa
  /// The largest principal stress too: uniaxial and biaxial strength are T_max, as in tests. An open point
  /// loses the same share of all its stiffness, as an isotropic crack band does.
  principal_stress,
  /// The same limit, met by the deviator alone: an open point goes on at constant volume until its mean
  /// tension is T_max as well. A crack then contracts sideways by half of its opening, and cannot localise.
  principal_deviator
};

/// Where a damage takes the cohesion C1 - C2: on the side of P = 0 that it belongs to (shear damage in
/// compression, tensile damage in tension), or on both.
enum class DamageSide { own, both };

/// Largest equivalent (von Mises) stress of concrete, against pressure, damage and strain rate (Eqs. 22, 23
/// and 30). Names as in Table 1, SI units. V: one point or several (lane_math.h).
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
  TensionLimit tension_limit = TensionLimit::principal_stress;
  /// As Eqs. 22 and 30 are printed: d takes the cohesion on both sides, d_t takes the mean tension alone.
  DamageSide shear_damage_side = DamageSide::both, tensile_damage_side = DamageSide::own;

  /// -I1 of a pressure (both compression positive).
  template<class V> V invariant_of(const V& pressure) const {
    return (invariant == Invariant::mean_stress ? 1. : 3.) * pressure;
  }

  /// Share of the cohesion C1 - C2 that the damages d and d_t have taken at a pressure.
  template<class V> V lost_cohesion(const V& shear_damage, const V& tensile_damage, const V& pressure) const {
    const bool everywhere = shear_damage_side == DamageSide::both;
    const V sheared = everywhere ? shear_damage : select(pressure >= 0., shear_damage, 0);
    return tensile_damage_side == DamageSide::both ? 1 - (1 - sheared) * (1 - tensile_damage) : sheared;
  }

  /// Factor of the effective deviatoric strain rate (1/s).
  template<class V> V rate_factor(const V& rate) const {
    return 1 + C3 * natural_logarithm(larger(rate, rate_floor));
  }

  template<class V> struct Strength {
    V stress;       ///< Pa
    V intact_share; ///< strength over that without damage: 1 where nothing is damaged
  };
  /// @param lost share of the cohesion that damage has taken (lost_cohesion): d of Eqs. 22 and 30
  /// @param tension largest mean tension, and principal one (TensionLimit), Pa: T_max (1 - d_t) of Eq. 30
  /// @param rate effective deviatoric strain rate, 1/s
  /// @param s deviator that is compared with the strength; only its direction matters, and only with the Lode
  ///   effect or with a limit on principal stresses
  template<Numbers V>
  Strength<V> operator()(const V& pressure, const V& lost, const V& tension, const V& rate,
                         const Sym<V>& s) const {
    const auto pressed = pressure >= 0.;
    const Strength<V> compression = compressive(pressure, lost), pull = tensile(pressure, lost, tension);
    V stress = select(pressed, compression.stress, pull.stress);
    const V c = needs_lode_angle() ? cos_lode(s) : broadcast<V>(0.5);
    if (lode_eccentricity < 1) {
      const V reduction = radius_of_section(c, eccentricity(pressure));
      stress *= lode_range == LodeRange::everywhere ? reduction : select(pressed, reduction, 1);
    }
    stress = smaller(V(stress * rate_factor(rate)), largest(c));
    if (tension_limit != TensionLimit::mean_stress)
      stress = smaller(stress, equivalent_at_principal(V(tension + pressure), c));
    return {larger(0, stress), select(pressed, compression.intact_share, pull.intact_share)};
  }

  Strength<double> operator()(double pressure, double lost, double tension, double rate,
                              const Sym3& s) const {
    return operator()<double>(pressure, lost, tension, rate, s);
  }

  /// Strength in extension over compression at a pressure.
  template<class V> V eccentricity(const V& pressure) const {
    if (!(lode_fading > 0)) return broadcast<V>(lode_eccentricity);
    return lode_eccentricity + (1 - lode_eccentricity) * smaller(1, larger(0, V(pressure / lode_fading)));
  }

  /// Radius of the deviatoric section of Willam and Warnke over that of triaxial compression, from the
  /// eccentricity e (extension) to 1 (compression).
  template<class V> static V lode_reduction(const Sym<V>& s, const std::type_identity_t<V>& e) {
    return radius_of_section(cos_lode(s), e);
  }

  /// Mean tension of an open point at which its largest principal stress is `limit`, if the whole stress is
  /// reduced, Pa: smaller than the limit unless all directions are pulled alike.
  /// @param mean  mean tension of the trial stress, Pa  @param s  its deviator, Pa
  template<class V> V limited_mean(const V& mean, const V& limit, const Sym<V>& s) const {
    if (tension_limit != TensionLimit::principal_stress) return limit;
    const V largest = mean + 2. / 3 * equivalent_stress(s) * cos_lode(s);
    return select(largest > limit, V(mean * limit / largest), limit);
  }

  void declare(Parameters::Section& section);

private:
  bool needs_lode_angle() const {
    return lode_eccentricity < 1 || tension_limit != TensionLimit::mean_stress ||
           bound == StrengthBound::principal_difference;
  }
  /// lode_reduction by the cosine c of the Lode angle.
  template<class V> static V radius_of_section(const V& c, const V& e) {
    const V a = 4 * (1 - e * e) * c * c, b = 2 * e - 1;
    return (2 * (1 - e * e) * c + b * square_root(V(a + 5 * e * e - 4 * e))) / (a + b * b);
  }
  /// Equivalent stress of a deviator whose largest principal value is s1 = 2/3 q c.
  template<class V> static V equivalent_at_principal(const V& s1, const V& c) { return 1.5 * s1 / c; }
  double cohesion() const { return C1 - C2; } ///< strength at P = 0, where both surfaces meet, Pa
  /// Eq. 22 at rate 1/s.
  template<class V> Strength<V> compressive(const V& pressure, const V& lost) const {
    const V p = invariant_of(larger(0, pressure)), decay = exponential_function(larger(-700, V(-A_N * p)));
    const V intact = C1 - C2 * decay + C4 * p;
    const V stress = intact - cohesion() * lost * decay;
    return {stress, stress / intact};
  }
  /// Eqs. 23 and 30 at rate 1/s.
  template<class V> Strength<V> tensile(const V& pressure, const V& lost, const V& tension) const {
    const V p = invariant_of(pressure), share = 1 - lost;
    return {select(p > -tension, V(cohesion() * share * (1 + p / tension)), 0), share};
  }
  /// Cosine of the Lode angle of a deviator: 1 in triaxial extension, 1/2 in triaxial compression, where no
  /// strength is reduced; that of no deviator is taken as 1/2.
  template<class V> static V cos_lode(const Sym<V>& s) {
    const V j2 = contract(s, s) / 2;
    const V cos3 = 1.5 * std::sqrt(3.) * determinant(s) / (j2 * square_root(j2));
    return cosine_of_third(select(j2 > 0., larger(-1, cos3), -1));
  }
  /// The equivalent stress that C5 allows at a Lode angle, by its cosine: the principal stress difference is
  /// 2 / sqrt(3) sin(Lode angle + 60 degrees) times the equivalent stress.
  template<class V> V largest(const V& c) const {
    switch (bound) {
    case StrengthBound::nothing:
      return broadcast<V>(std::numeric_limits<double>::infinity());
    case StrengthBound::principal_difference: {
      const V sine = square_root(larger(0, V(1 - c * c)));
      return C5 / ((sine + std::sqrt(3.) * c) / std::sqrt(3.));
    }
    case StrengthBound::equivalent_stress:
      break;
    }
    return broadcast<V>(C5);
  }
};

} // namespace spall
