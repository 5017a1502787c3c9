#pragma once

#include "macro/material/concrete_step.h"
#include "macro/material/crush_curve.h"
#include "macro/material/material_law.h"

#include <array>
#include <cmath>

namespace spall {

/// Concrete of Holmquist, Johnson and Cook (14th International Symposium on Ballistics, 1993). SI units,
/// tension positive, pressures and mu compression positive; P* = P / fc, e* the strain rate over the
/// reference rate.
///
///   pressure   CrushCurve
///   strength   S / fc = min(SFMAX, (A (1 - D) + B P*^N) (1 + C ln e*))                P >= 0
///              S / fc = A (1 - D) (1 + P / limit) (1 + C ln e*)                       P < 0
///   tension    mean stress at most limit = T (1 - D), or that of a damage table (ConcreteTension)
///   damage     dD = (dp + dmu_p) / e_f,   e_f = max(EFMIN, D1 (P* + T*)^D2)
///
/// p is the equivalent plastic strain, mu_p the crushed volumetric strain. The strain rate is the equivalent
/// deviatoric one of the step, at least the rate floor.
struct Hjc {
  static constexpr const char* name = "HJC";
  static constexpr bool ductile = false;

  double density = required;                                     ///< kg/m^3
  double G = required;                                           ///< shear modulus, Pa
  double fc = required;                                          ///< compressive strength, Pa
  double A = required, B = required, N = required, C = required; ///< 1
  double SFMAX = required;                                       ///< 1
  double reference_rate = 1;                                     ///< 1/s
  double rate_floor = 1e-3; ///< 1/s; keeps the logarithm of a point at rest finite
  double D1 = required, D2 = required, EFMIN = required; ///< 1
  CrushCurve curve;
  ConcreteTension tension; ///< T is tension.tensile.T_max

  struct State : ConcreteState {
    double largest_compression = 0; ///< largest mu so far
  };
  /// History variables by name, for output.
  static constexpr std::array<HistoryField<State>, 5> fields = {
      {{"largest_compression", &State::largest_compression, "1"},
       {"shear_damage", &State::shear_damage, "1"},
       {"tensile_damage", &State::tensile_damage, "1"},
       {"tensile_strain", &State::tensile_strain, "1"},
       {"plastic_strain", &State::plastic_strain, "1"}}};

  double bulk_modulus() const { return curve.elastic_modulus(); } ///< of the uncrushed material, Pa
  double shear_modulus() const { return G; }
  double T() const { return tension.tensile.T_max; } ///< Pa
  /// Longitudinal wave speed of the stiffest branch the point can be on, m/s: for the time step. dP / dmu
  /// over the initial density is dP / d density.
  double sound_speed(const State& state) const {
    return std::sqrt((curve.stiffest_modulus(state.largest_compression) + 4. / 3 * G) / density);
  }
  /// Elastic moduli of that branch.
  Stiffness elastic(const State& state) const {
    return {.bulk = (1 + state.largest_compression) * curve.stiffest_modulus(state.largest_compression),
            .shear = G};
  }
  /// Free energy: what pressure, tension and shear give back. Crushing is not.
  StoredEnergy stored_energy(const Sym3& stress, const State& state) const {
    const double P = -trace(stress) / 3, largest = state.largest_compression;
    return {P < 0 ? tension_energy(P, state, curve.touching_modulus(largest), curve.plastic_strain(largest))
                  : curve.stored_energy(P, largest, state.opened),
            shape_energy(stress, state, G)};
  }

  /// 1 + C ln e* of a strain rate, 1/s.
  double rate_factor(double rate) const {
    return 1 + C * std::log(std::max(rate, rate_floor) / reference_rate);
  }
  /// e_f at a pressure, Pa.
  double failure_strain(double P) const {
    return std::max(EFMIN, D1 * std::pow(std::max(0., (P + T()) / fc), D2));
  }

  // For ConcreteStep, which says what they are.
  TrialPressure press(State& state, double mu) const;
  double tension_limit(const State& state, double) const { return T() * (1 - state.shear_damage); }
  double strength(const State& state, double P, double limit, double rate, const Sym3&) const;
  void harm(State& state, double plastic, double crushed, double P, double, const Sym3&) const {
    state.shear_damage = std::min(1., state.shear_damage + (plastic + crushed) / failure_strain(P));
  }

  /// Advances the (already rotated) Cauchy stress and the state by one step (ConcreteStep).
  Stiffness update(Sym3& stress, State& state, const StrainStep& step) const {
    return ConcreteStep<Hjc>(*this, stress, state, step).finish(stress);
  }

  /// Binds the keys of a section. `needed`: whether the constants must be set (default: always).
  void declare(Parameters& parameters, Needed needed = {}, const std::string& section = name);
  /// Checks what no single key can. @throws InputError, which names `file` and the key in `section`
  void validate(const std::string& file, const std::string& section = name) const;
  /// Finds where the curve locks, and makes the curves of the damage table for points of these spacings (m).
  /// @throws InputError: the damage table is unreadable or not for this material in tension
  void prepare(const std::vector<double>& spacings);
  bool softens() const { return true; } ///< D takes the cohesion
  bool needs_spacing() const { return tension.needs_spacing(); }
  double strength_limit() const { return SFMAX * fc; } ///< largest stress difference, Pa
  Description describe() const { return {{"damage_table", tension.table()}}; }
};

} // namespace spall
