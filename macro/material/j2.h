#pragma once

#include "macro/material/material.h"
#include "shared/input/parameters.h"

#include <array>
#include <functional>
#include <utility>

namespace spall {

/// Metal: isotropic hypoelasticity and von Mises plasticity with linear isotropic hardening (Table 2), radial
/// return as in Simo & Hughes, Computational Inelasticity, box 3.2. SI units, tension positive.
struct J2 {
  double youngs_modulus = required;    ///< Pa
  double poisson_ratio = required;     ///< 1
  double initial_yield = required;     ///< Pa
  double hardening_modulus = required; ///< slope of yield stress against plastic strain, Pa
  double density = required;           ///< kg/m^3

  struct State {
    double plastic_strain = 0; ///< equivalent, accumulated
  };
  /// History variables by name, for output.
  static constexpr std::array<std::pair<const char*, double State::*>, 1> fields = {
      {{"plastic_strain", &State::plastic_strain}}};

  double bulk_modulus() const { return youngs_modulus / (3 * (1 - 2 * poisson_ratio)); }
  double shear_modulus() const { return youngs_modulus / (2 * (1 + poisson_ratio)); }
  double yield_stress(const State& state) const {
    return initial_yield + hardening_modulus * state.plastic_strain;
  }
  /// Longitudinal wave speed, m/s: for the time step.
  double sound_speed(const State&) const {
    return std::sqrt((bulk_modulus() + 4. / 3 * shear_modulus()) / density);
  }

  /// Moduli of a small elastic change, for the stiffness.
  Tangent elastic(const State&) const { return {.bulk = bulk_modulus(), .shear = shear_modulus()}; }

  /// Advances the (already rotated) Cauchy stress and the state by one step; returns the consistent tangent.
  Tangent update(Sym3& stress, State& state, const StrainStep& step) const;

  /// Binds the keys of a section. `needed`: whether the constants must be set (default: always).
  void declare(Parameters& parameters, std::function<bool()> needed = {}, const std::string& section = "J2");
};

inline Tangent J2::update(Sym3& stress, State& state, const StrainStep& step) const {
  const double K = bulk_modulus(), G = shear_modulus(), H = hardening_modulus;

  // (i) elastic predictor
  const double mean = trace(stress) / 3 + K * trace(step.increment);
  const Sym3 de = deviator(step.increment);
  Sym3 s = deviator(stress);
  for (int i = 0; i < 6; ++i) s[i] += 2 * G * de[i];
  const double q = equivalent_stress(s);

  // (ii) admissibility
  const double excess = q - yield_stress(state);
  Tangent tangent{.bulk = K, .shear = G};

  // (iii) return map: along the trial deviator, closed form for linear hardening
  if (excess > 0) {
    const double plastic = excess / (3 * G + H);
    const double kept = 1 - 3 * G * plastic / q; // beta of box 3.2
    const double norm = std::sqrt(1.5) / q;      // 1 / |s|
    for (int i = 0; i < 6; ++i) {
      tangent.direction[i] = s[i] * norm;
      s[i] *= kept;
    }
    state.plastic_strain += plastic;
    tangent.shear = G * kept;
    tangent.flow = G * (1 / (1 + H / (3 * G)) - (1 - kept));
  }

  for (int i = 0; i < 6; ++i) stress[i] = s[i] + (i < 3 ? mean : 0);
  return tangent;
}

} // namespace spall
