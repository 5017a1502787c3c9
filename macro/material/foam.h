#pragma once

#include "macro/material/material_law.h"

#include <array>
#include <vector>

namespace spall {

/// Soil, sand or a crushable foam of Krieg (Sandia SC-DR-72-0883, 1972), which programs for impact call soil
/// and crushable foam. SI units, tension positive, pressure p and volumetric strain e = -ln J compression
/// positive.
///
///   crushing    p = piecewise linear in e, from (0, 0) through the given points, on with the last slope
///   unloading   dp = K de below the largest e so far, and back the same way
///   strength    s : s / 2 <= a0 + a1 p + a2 p^2, not less than 0, and equivalent stress at most the cap
///   tension     p >= -T: a point that reaches it separates. From then on it carries nothing while p < 0, and
///               everything again when it is pressed.
///
/// Flow is at constant volume, radially to the strength. Separated points give nothing back when they close:
/// the usual cut-off, which keeps -T while the soil opens, would return what opening has cost.
struct Foam {
  static constexpr const char* name = "Foam";
  static constexpr bool ductile = false;

  double density = required;                          ///< kg/m^3
  double G = required;                                ///< shear modulus, Pa
  double K = required;                                ///< bulk modulus of unloading, Pa
  double a0 = required, a1 = required, a2 = required; ///< Pa^2, Pa, 1
  double T = required;                                ///< largest mean tension, Pa
  double cap = required;                              ///< largest equivalent stress, Pa; NaN: none
  std::vector<double> strains, pressures;             ///< points of the crushing curve: e and p, 1 and Pa

  struct State {
    double compaction = 0;     ///< largest e so far
    double tensile_damage = 0; ///< 1: separated
    double plastic_strain = 0; ///< equivalent, accumulated
  };
  /// History variables by name, for output.
  static constexpr std::array<HistoryField<State>, 3> fields = {
      {{"compaction", &State::compaction, "1"},
       {"tensile_damage", &State::tensile_damage, "1"},
       {"plastic_strain", &State::plastic_strain, "1"}}};

  double bulk_modulus() const { return K; }
  double shear_modulus() const { return G; }
  /// Longitudinal wave speed of unloading, m/s: for the time step.
  double sound_speed(const State&) const { return std::sqrt((K + 4. / 3 * G) / density); }
  Stiffness elastic(const State&) const { return {.bulk = K, .shear = G}; }
  /// Free energy: p^2 / 2 K + s : s / 4 G. Crushing gives nothing back.
  StoredEnergy stored_energy(const Sym3& stress, const State&) const {
    const Sym3 s = deviator(stress);
    const double mean = trace(stress) / 3;
    return {mean * mean / (2 * K), contract(s, s) / (4 * G)};
  }

  struct Crushing {
    double pressure, modulus; ///< Pa; modulus = dp / de
  };
  /// The crushing curve at e >= 0.
  Crushing crush(double e) const;
  /// Largest equivalent stress at a pressure, Pa.
  double strength(double p) const {
    return std::fmin(strength_limit(), std::sqrt(3 * std::fmax(0, a0 + p * (a1 + p * a2))));
  }

  /// Advances the (already rotated) Cauchy stress and the state by one step. Returns the stiffness of the
  /// present branch and of the radial return.
  Stiffness update(Sym3& stress, State& state, const StrainStep& step) const;

  /// Binds the keys of a section. `needed`: whether the constants must be set (default: always).
  void declare(Parameters& parameters, Needed needed = {}, const std::string& section = name);
  /// @throws InputError: no curve, one that falls or is stiffer than unloading, a strength that grows with
  /// tension. Names `file` and the key in `section`
  void validate(const std::string& file, const std::string& section = name) const;
  void prepare(const std::vector<double>&) {} ///< the same at any spacing
  bool softens() const { return true; }       ///< separation takes the strength
  bool needs_spacing() const { return false; }
  /// Largest stress difference, Pa.
  double strength_limit() const { return std::isnan(cap) ? std::numeric_limits<double>::infinity() : cap; }
  Description describe() const { return {}; }
};

} // namespace spall
