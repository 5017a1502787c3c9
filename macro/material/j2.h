#pragma once

#include "macro/material/material_law.h"

#include <array>

namespace spall {

/// Metal: isotropic hypoelasticity and von Mises plasticity with linear isotropic hardening (Table 2), radial
/// return as in Simo & Hughes, Computational Inelasticity, box 3.2. SI units, tension positive.
struct J2 {
  static constexpr const char* name = "J2";
  static constexpr bool ductile = true;

  double youngs_modulus = required;    ///< Pa
  double poisson_ratio = required;     ///< 1
  double initial_yield = required;     ///< Pa
  double hardening_modulus = required; ///< slope of yield stress against plastic strain, Pa
  double density = required;           ///< kg/m^3

  template<class V> struct StateOf {
    V plastic_strain = broadcast<V>(0); ///< equivalent, accumulated
  };
  using State = StateOf<double>;
  /// History variables by name, for output.
  static constexpr std::array<HistoryField<State>, 1> fields = {
      {{"plastic_strain", &State::plastic_strain, "1"}}};

  double bulk_modulus() const { return youngs_modulus / (3 * (1 - 2 * poisson_ratio)); }
  double shear_modulus() const { return youngs_modulus / (2 * (1 + poisson_ratio)); }
  template<class V> V yield_stress(const StateOf<V>& state) const {
    return initial_yield + hardening_modulus * state.plastic_strain;
  }
  /// Longitudinal wave speed, m/s: for the time step.
  double sound_speed(const State&) const {
    return std::sqrt((bulk_modulus() + 4. / 3 * shear_modulus()) / density);
  }

  /// Elastic moduli.
  Stiffness elastic(const State&) const { return {.bulk = bulk_modulus(), .shear = shear_modulus()}; }

  /// Free energy: mean^2 / 2 K + s : s / 4 G. What hardening stores is not given back.
  StoredEnergy stored_energy(const Sym3& stress, const State&) const {
    const Sym3 s = deviator(stress);
    const double mean = trace(stress) / 3;
    return {mean * mean / (2 * bulk_modulus()), contract(s, s) / (4 * shear_modulus())};
  }

  /// Advances the (already rotated) Cauchy stress and the state by one step; returns the consistent tangent.
  template<class V, class Of = double>
  StiffnessOf<V> update(Sym<V>& stress, StateOf<V>& state, const StrainStepOf<V, Of>& step) const;

  /// Binds the keys of a section. `needed`: whether the constants must be set (default: always).
  void declare(Parameters& parameters, Needed needed = {}, const std::string& section = name);
  void validate(const std::string&, const std::string&) const {} ///< no key depends on another
  void prepare(const std::vector<double>&) {}                    ///< the same at any spacing
  bool softens() const { return false; }
  bool needs_spacing() const { return false; }
  /// Largest stress difference, Pa: the yield stress, without bound if the material hardens.
  double strength_limit() const {
    return hardening_modulus > 0 ? std::numeric_limits<double>::infinity() : initial_yield;
  }
  Description describe() const { return {}; }
};

template<class V, class Of>
StiffnessOf<V> J2::update(Sym<V>& stress, StateOf<V>& state, const StrainStepOf<V, Of>& step) const {
  const double K = bulk_modulus(), G = shear_modulus(), H = hardening_modulus;

  // (i) elastic predictor: trial state
  const V mean = trace(stress) / 3 + K * trace(step.increment);
  Sym<V> s = deviator(stress) + 2 * G * deviator(step.increment);
  const V q = equivalent_stress(s);

  // (ii) admissibility
  const V excess = q - yield_stress(state);
  const Mask<V> flows = excess > 0;
  StiffnessOf<V> tangent{.bulk = broadcast<V>(K), .shear = broadcast<V>(G)};

  // (iii) return map: along the trial deviator, closed form for linear hardening
  if (any(flows)) {
    const V plastic = select(flows, excess / (3 * G + H), 0);
    const V return_factor = 1 - select(flows, 3 * G * plastic / q, 0); // beta of box 3.2
    tangent.direction = select(flows, std::sqrt(1.5) / q, 0) * s;      // s / |s|
    s *= return_factor;
    state.plastic_strain += plastic;
    tangent.shear = G * return_factor;
    tangent.flow = select(flows, G * (1 / (1 + H / (3 * G)) - (1 - return_factor)), 0);
  }

  stress = plus_spherical(s, mean);
  return tangent;
}

} // namespace spall
