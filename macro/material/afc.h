#pragma once

#include "macro/material/failure_surface.h"
#include "macro/material/hydrostat.h"
#include "macro/material/material_law.h"
#include "macro/material/shear_damage.h"
#include "macro/material/tensile_damage.h"

#include <array>
#include <cmath>

namespace spall {

/// How the volumetric strain mu follows from J.
enum class VolumetricStrain {
  logarithmic,  ///< mu = -ln J: small strain increments add up to it
  density_ratio ///< mu = 1 / J - 1
};

/// Concrete: the Advanced Fundamental Concrete model (Eqs. 20-24), with tensile damage informed by
/// microcracks (Eq. 30) if a damage table is prepared. Constants of Table 1 in SI units; tension positive,
/// pressures and mu compression positive.
///
/// The pressure is a function of J and of the largest compression reached, cut off at the tension limit
/// T_max (1 - d_t), which may grow with the strain rate. A point that has opened closes along the same line,
/// except for the part of the opening that stays. The deviator is elastic, then returned radially to the
/// failure surface at that pressure.
struct Afc {
  static constexpr const char* name = "AFC";
  static constexpr bool softens = true;

  double density = required; ///< kg/m^3
  double G = required;       ///< shear modulus, Pa
  VolumetricStrain volumetric_strain = VolumetricStrain::logarithmic;
  Hydrostat hydrostat;    ///< Eqs. 20 and 21
  FailureSurface surface; ///< Eqs. 22, 23 and 30
  ShearDamage shear;      ///< Eq. 24
  TensileDamage tensile;  ///< Eq. 30

  struct State : TensileDamage::State {
    double largest_compression = 0; ///< largest mu so far
    double shear_damage = 0;        ///< d of Eq. 24
    double plastic_strain = 0;      ///< effective, deviatoric
  };
  /// History variables by name, for output.
  static constexpr std::array<std::pair<const char*, double State::*>, 6> fields = {
      {{"largest_compression", &State::largest_compression},
       {"shear_damage", &State::shear_damage},
       {"tensile_damage", &State::tensile_damage},
       {"tensile_strain", &State::tensile_strain},
       {"plastic_strain", &State::plastic_strain},
       {"tensile_rate_factor", &State::tensile_rate_factor}}};

  double bulk_modulus() const { return hydrostat.elastic_modulus(); } ///< of the uncrushed material, Pa
  double shear_modulus() const { return G; }
  double youngs_modulus() const { return youngs_modulus_of(bulk_modulus(), G); }
  double poisson_ratio() const { return poisson_ratio_of(bulk_modulus(), G); }
  /// Longitudinal wave speed of the stiffest branch the point can be on (unloading), m/s: for the time step.
  double sound_speed(const State& state) const {
    return std::sqrt((hydrostat.unloading_modulus(state.largest_compression) + 4. / 3 * G) / density);
  }
  /// Elastic moduli of the stiffest branch the point can be on (unloading).
  Stiffness elastic(const State& state) const {
    return {.bulk = hydrostat.unloading_modulus(state.largest_compression), .shear = G};
  }

  /// Free energy: P^2 / 2 K + s : s / 4 G, K of unloading.
  StoredEnergy stored_energy(const Sym3& stress, const State& state) const {
    const Sym3 s = deviator(stress);
    const double p = -trace(stress) / 3;
    return {p * p / (2 * hydrostat.unloading_modulus(state.largest_compression)), contract(s, s) / (4 * G)};
  }

  /// Advances the (already rotated) Cauchy stress and the state by one step. Returns the stiffness of
  /// stabilisation(): not the derivative of the stress.
  Stiffness update(Sym3& stress, State& state, const StrainStep& step) const;

  /// Binds the keys of a section. `needed`: whether its constants must be set (default: always).
  void declare(Parameters& parameters, std::function<bool()> needed = {}, const std::string& section = name);
  /// Checks what no single key can. @throws InputError, which names `file` and the key in `section`
  void validate(const std::string& file, const std::string& section = name) const;
  /// Makes the curves of tensile damage for points of these spacings (m). Call after reading the inputs.
  /// @throws InputError: the damage table is unreadable or was made for another material
  void prepare(const std::vector<double>& spacings) {
    tensile.prepare(spacings, youngs_modulus(), poisson_ratio());
  }
  bool needs_spacing() const { return tensile.uses_table(); }
  /// Largest stress difference, Pa: C5, at any strain rate, unless it is read to limit nothing.
  double strength_limit() const {
    return surface.bound == StrengthBound::nothing ? std::numeric_limits<double>::infinity() : surface.C5;
  }
  Description describe() const {
    return {{"damage_table", tensile.uses_table() ? tensile.table : std::string()}};
  }

private:
  /// Trial state of a step: elastic predictor without strength and without tension cut-off.
  struct Trial {
    double pressure, modulus; ///< P and dP / dmu of the hydrostat, Pa
    double crushed;           ///< plastic volumetric strain of the step (compression positive)
    Sym3 deviator;            ///< Pa
    double equivalent;        ///< equivalent stress of the deviator, Pa
    double rate;              ///< effective deviatoric strain rate, 1/s
  };
  Trial predict(const Sym3& stress, State& state, const StrainStep& step) const;

  using Curve = TensileDamage::Curve;
  using Strength = FailureSurface::Strength;
  Strength strength_at(const Trial& trial, const State& state, const Curve& curve) const {
    const double lost = surface.lost_cohesion(state.shear_damage, state.tensile_damage, trial.pressure);
    return surface(trial.pressure, lost, tensile.limit(state, curve), trial.rate, trial.deviator);
  }

  struct Cutoff {
    bool open;       ///< whether the trial pressure is beyond the tension limit
    double pressure; ///< after the cut-off, Pa
    double opening;  ///< volumetric strain that has opened, if open
  };
  Cutoff cut_off(const Trial& trial, State& state, const Curve& curve) const;

  struct Flow {
    bool plastic;         ///< whether the trial state was outside of the failure surface
    double return_factor; ///< of the trial deviator: what the return map keeps of it
    double strain;        ///< equivalent plastic strain of the step
  };
  Flow return_map(const Trial& trial, const Strength& strength) const {
    if (!(trial.equivalent > strength.stress)) return {false, 1, 0};
    return {true, strength.stress / trial.equivalent, (trial.equivalent - strength.stress) / (3 * G)};
  }
  /// Plastic strains, the opening that slip keeps, and shear damage.
  void book(State& state, const Trial& trial, const Cutoff& cutoff, const Flow& flow, double tensile_strain,
            const StrainStep& step) const;

  Stiffness stabilisation(const Trial& trial, const State& state, const Cutoff& cutoff,
                          const Strength& strength, const Flow& flow, double volume_ratio) const;

  double compression(double volume_ratio) const {
    return volumetric_strain == VolumetricStrain::logarithmic ? -std::log(volume_ratio)
                                                              : 1 / volume_ratio - 1;
  }
};

inline Stiffness Afc::update(Sym3& stress, State& state, const StrainStep& step) const {
  // (i) trial state: pressure of the hydrostat (Eqs. 20 and 21), elastic predictor of the deviator
  const Trial trial = predict(stress, state, step);

  // (ii) strength at the trial pressure, with the damages and the rate factor so far (Eqs. 22 and 23)
  const Curve& curve = tensile.curve_at(step.spacing);
  tensile.begin(state, curve, trial.pressure, step);
  Strength strength = strength_at(trial, state, curve);

  // (iii) tensile damage, and the strength it leaves (Eq. 30)
  const auto growth = tensile.grow(state, curve,
                                   {.pressure = trial.pressure,
                                    .modulus = trial.modulus,
                                    .deviator = trial.deviator,
                                    .equivalent = trial.equivalent,
                                    .shear_modulus = G,
                                    .return_factor = return_map(trial, strength).return_factor,
                                    .start = stress,
                                    .deformation = step.deformation});
  if (growth.damaged) strength = strength_at(trial, state, curve);

  // (iv) tension cut-off: beyond the limit the point opens
  const Cutoff cutoff = cut_off(trial, state, curve);

  // (v) radial return to the failure surface
  const Flow flow = return_map(trial, strength);
  stress = plus_spherical(flow.return_factor * trial.deviator, -cutoff.pressure);

  // (vi) history, with shear damage (Eq. 24)
  book(state, trial, cutoff, flow, growth.strain, step);
  return stabilisation(trial, state, cutoff, strength, flow, step.volume_ratio);
}

inline Afc::Trial Afc::predict(const Sym3& stress, State& state, const StrainStep& step) const {
  Trial trial;
  const double mu = compression(step.volume_ratio) + state.opened;
  trial.crushed = 0;
  if (mu > state.largest_compression) {
    trial.crushed = hydrostat.plastic_strain(mu) - hydrostat.plastic_strain(state.largest_compression);
    state.largest_compression = mu;
  }
  const auto [pressure, modulus] = hydrostat(mu, state.largest_compression);
  trial.pressure = pressure;
  trial.modulus = modulus;

  const Sym3 de = deviator(step.increment);
  trial.rate = std::sqrt(2. / 3 * contract(de, de)) / step.dt;
  trial.deviator = deviator(stress) + 2 * G * de;
  trial.equivalent = equivalent_stress(trial.deviator);
  return trial;
}

inline Afc::Cutoff Afc::cut_off(const Trial& trial, State& state, const Curve& curve) const {
  const double limit = tensile.limit(state, curve);
  if (!(trial.pressure < -limit)) return {.open = false, .pressure = trial.pressure, .opening = 0};
  const double opening = TensileDamage::opening(state, trial.pressure, trial.modulus, limit);
  tensile.keep_open(state, opening);
  return {.open = true, .pressure = -limit, .opening = opening};
}

inline void Afc::book(State& state, const Trial& trial, const Cutoff& cutoff, const Flow& flow,
                      double tensile_strain, const StrainStep& step) const {
  if (flow.plastic) {
    state.plastic_strain += flow.strain;
    if (cutoff.open) tensile.keep_open_by_slip(state, cutoff.opening, flow.strain, trace(step.increment));
    state.tensile_plastic_strain += (1 - flow.return_factor) * tensile_strain;
    shear.add_flow(state.shear_damage, flow.strain, surface.invariant_of(cutoff.pressure), step.spacing);
  }
  shear.add_crushing(state.shear_damage, trial.crushed, hydrostat.C9);
}

/// The bulk modulus of the current branch (0 beyond the tension cut-off) and the shear stiffness of the
/// radial return at fixed pressure: 2 G S / q across the flow direction and 0 along it. The dependence of S
/// on pressure is left out because it is not symmetric. Shear is further scaled by the share of the strength
/// that shear damage has left, and both by 1 - d_t in tension: a cracked point must not be held together by
/// its stabilisation.
inline Stiffness Afc::stabilisation(const Trial& trial, const State& state, const Cutoff& cutoff,
                                    const Strength& strength, const Flow& flow, double volume_ratio) const {
  const double soundness = trial.pressure < 0 ? 1 - state.tensile_damage : 1;
  Stiffness stiffness{.bulk = cutoff.open ? 0 : trial.modulus * soundness,
                      .shear = G * soundness * strength.intact_share * flow.return_factor,
                      .limit = strength.stress};
  if (volumetric_strain == VolumetricStrain::density_ratio) stiffness.bulk /= volume_ratio;
  if (flow.plastic) {
    stiffness.flow = stiffness.shear;
    stiffness.direction = std::sqrt(1.5) / trial.equivalent * trial.deviator;
  }
  return stiffness;
}

} // namespace spall
