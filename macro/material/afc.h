#pragma once

#include "macro/material/cracks.h"
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
/// The pressure is a function of J and of the largest compression reached. Pressed, a point flows: the
/// deviator is elastic, then returned radially to the failure surface at that pressure. Pulled, it cracks:
/// what exceeds the limit T_max (1 - d_t) of the mean tension, which may grow with the strain rate, or the
/// strength at the mean tension, takes stiffness from it, and it closes along the secant (Cracks, which
/// states the free energy).
struct Afc {
  static constexpr const char* name = "AFC";
  static constexpr bool softens = true;

  double density = required; ///< kg/m^3
  double G = required;       ///< shear modulus, Pa
  VolumetricStrain volumetric_strain = VolumetricStrain::logarithmic;
  Hydrostat hydrostat;    ///< Eqs. 20 and 21
  FailureSurface surface; ///< Eqs. 22, 23 and 30
  ShearDamage shear;      ///< Eq. 24
  Cracks cracks;          ///< Eqs. 27 and 28
  TensileDamage tensile;  ///< Eq. 30

  struct State : TensileDamage::State {
    double largest_compression = 0; ///< largest mu so far
    double shear_damage = 0;        ///< d of Eq. 24
    double plastic_strain = 0;      ///< effective, deviatoric
  };
  /// History variables by name, for output.
  static constexpr std::array<HistoryField<State>, 6> fields = {
      {{"largest_compression", &State::largest_compression, "1"},
       {"shear_damage", &State::shear_damage, "1"},
       {"tensile_damage", &State::tensile_damage, "1"},
       {"tensile_strain", &State::tensile_strain, "1"},
       {"plastic_strain", &State::plastic_strain, "1"},
       {"tensile_rate_factor", &State::tensile_rate_factor, "1"}}};

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

  /// Free energy (Cracks).
  StoredEnergy stored_energy(const Sym3& stress, const State& state) const;

  /// Advances the (already rotated) Cauchy stress and the state by one step. Returns the stiffness of
  /// stabilisation(): not the derivative of the stress.
  Stiffness update(Sym3& stress, State& state, const StrainStep& step) const;

  /// Binds the keys of a section. `needed`: whether its constants must be set (default: always).
  void declare(Parameters& parameters, Needed needed = {}, const std::string& section = name);
  /// Checks what no single key can. @throws InputError, which names `file` and the key in `section`
  void validate(const std::string& file, const std::string& section = name) const;
  /// Makes the curves of tensile damage for points of these spacings (m). Call after reading the inputs.
  /// @throws InputError: the damage table is unreadable or not for this material in tension
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
  /// Trial state of a step: predictor without strength and without tension cut-off.
  struct Trial {
    double pressure, modulus; ///< P and dP / dmu of the hydrostat, Pa
    double opened;            ///< State::opened before the step
    double crushed;           ///< plastic volumetric strain of the step (compression positive)
    bool open;                ///< whether the point is in mean tension
    double strain;            ///< volumetric strain since the faces touched, e of Cracks
    Sym3 deviator;            ///< with the shear stiffness that an open point has left, Pa
    double equivalent;        ///< equivalent stress of the deviator, Pa
    double carried, share;    ///< equivalent stress and State::shear_share before the step
    double kept;              ///< what opening leaves of the deviator before the step
    double shape;             ///< equivalent deviatoric strain of the step
    double rate;              ///< the same per time, 1/s
  };
  Trial predict(const Sym3& stress, State& state, const StrainStep& step) const;

  using Curve = TensileDamage::Curve;
  using Strength = FailureSurface::Strength;
  Strength strength_at(double pressure, const Trial& trial, const State& state, const Curve& curve) const {
    const double lost = surface.lost_cohesion(state.shear_damage, state.tensile_damage, pressure);
    return surface(pressure, lost, tensile.limit(state, curve), trial.rate, trial.deviator);
  }
  /// Pressure that the tension limit and the cracks so far leave of the trial pressure, Pa. That of an open
  /// point is below zero even if nothing is left of it: its strength is the one in tension, not the cohesion
  /// at P = 0.
  double cracked_pressure(const Trial& trial, const State& state, double limit) const {
    constexpr double least_tension = 1e-30;
    return trial.open ? -std::max(least_tension, Cracks::mean_tension(state, -trial.pressure, limit))
                      : trial.pressure;
  }
  /// Strength over the equivalent stress of the trial state, at most 1: what the strength keeps of the
  /// deviator.
  static double return_factor(const Trial& trial, const Strength& strength) {
    return trial.equivalent > strength.stress ? strength.stress / trial.equivalent : 1;
  }
  /// Flow: plastic strain, and shear damage. @param pressure after the tension limit, Pa
  void flow(State& state, const Trial& trial, double factor, double pressure, double tensile_strain,
            double spacing) const;
  /// Cracking in tension: shear stiffness, the opening that slip keeps, and shear damage.
  void crack(State& state, const Trial& trial, double factor, double pressure, bool opens,
             double tensile_strain, const StrainStep& step) const;

  Stiffness stabilisation(const Trial& trial, const State& state, bool opens, const Strength& strength,
                          double factor, double volume_ratio) const;

  double compression(double volume_ratio) const {
    return volumetric_strain == VolumetricStrain::logarithmic ? -std::log(volume_ratio)
                                                              : 1 / volume_ratio - 1;
  }
};

inline Stiffness Afc::update(Sym3& stress, State& state, const StrainStep& step) const {
  // (i) trial state: pressure of the hydrostat (Eqs. 20 and 21), predictor of the deviator
  const Trial trial = predict(stress, state, step);

  // (ii) strength at the trial state, with the damages and the rate factor so far (Eqs. 22 and 23)
  const Curve& curve = tensile.curve_at(step.spacing);
  tensile.begin(state, curve, trial.pressure, step);
  double limit = tensile.limit(state, curve), pressure = cracked_pressure(trial, state, limit);
  Strength strength = strength_at(pressure, trial, state, curve);

  // (iii) tensile damage, and the strength it leaves (Eq. 30). The weight of kappa is that of the stress
  // before: under mixed stress d_t is late by up to one step.
  const auto growth = tensile.grow(state, curve,
                                   {.pressure = trial.pressure,
                                    .modulus = trial.modulus,
                                    .deviator = trial.deviator,
                                    .equivalent = trial.equivalent,
                                    .shear_modulus = G * state.shear_share,
                                    .return_factor = return_factor(trial, strength),
                                    .carried = trial.kept * trial.carried,
                                    .deformation = step.deformation});
  if (growth.damaged) {
    limit = tensile.limit(state, curve);
    pressure = cracked_pressure(trial, state, limit);
    strength = strength_at(pressure, trial, state, curve);
  }

  // (iv) stress: the volume opens beyond the tension limit, the deviator is returned to the failure surface
  const bool opens = trial.open && cracks.open(state, trial.strain, trial.modulus, limit);
  const double factor = return_factor(trial, strength);
  stress = plus_spherical(factor * trial.deviator, -pressure);

  // (v) history, with shear damage (Eq. 24)
  if (trial.open && cracks.opening == Opening::cracks)
    crack(state, trial, factor, pressure, opens, growth.strain, step);
  else if (factor < 1)
    flow(state, trial, factor, pressure, growth.strain, step.spacing);
  shear.add_crushing(state.shear_damage, trial.crushed, hydrostat.C9);
  return stabilisation(trial, state, opens, strength, factor, step.volume_ratio);
}

inline Afc::Trial Afc::predict(const Sym3& stress, State& state, const StrainStep& step) const {
  Trial trial;
  trial.opened = state.opened;
  const double mu = compression(step.volume_ratio) + state.opened;
  trial.crushed = 0;
  if (mu > state.largest_compression) {
    trial.crushed = hydrostat.plastic_strain(mu) - hydrostat.plastic_strain(state.largest_compression);
    state.largest_compression = mu;
  }
  const auto [pressure, modulus] = hydrostat(mu, state.largest_compression);
  trial.pressure = pressure;
  trial.modulus = modulus;
  trial.open = pressure < 0;
  trial.strain = -pressure / modulus;

  // An open point keeps its share of s0, a closed one what it carries (Cracks).
  const Sym3 before = deviator(stress), de = deviator(step.increment);
  trial.carried = equivalent_stress(before);
  trial.share = state.shear_share;
  state.shear_share = trial.open ? state.shear_left : 1;
  trial.kept = !trial.open ? 1 : trial.share > 0 ? state.shear_share / trial.share : 0;
  trial.shape = std::sqrt(2. / 3 * contract(de, de));
  trial.rate = trial.shape / step.dt;
  trial.deviator = trial.kept * before + 2 * G * state.shear_share * de;
  trial.equivalent = equivalent_stress(trial.deviator);
  return trial;
}

inline void Afc::flow(State& state, const Trial& trial, double factor, double pressure, double tensile_strain,
                      double spacing) const {
  const double strain = (1 - factor) * trial.equivalent / (3 * G);
  state.plastic_strain += strain;
  state.tensile_plastic_strain += (1 - factor) * tensile_strain;
  shear.add_flow(state.shear_damage, strain, surface.invariant_of(pressure), spacing);
}

/// What Eq. 24 counts as plastic strain is in tension what stays, and the growth of what cracks have added to
/// the strain of the deviator: q0 (1 - share) / 3 G with q0 the equivalent stress of s0. A point without
/// shear stiffness has no s0 any more: all of its strain counts while it opens further, and the slip of its
/// cracks otherwise.
inline void Afc::crack(State& state, const Trial& trial, double factor, double pressure, bool opens,
                       double tensile_strain, const StrainStep& step) const {
  const double lost = 1 - state.shear_share, slip = Cracks::slip(lost * trial.shape, trace(step.increment));
  double strain = 0;
  if (factor < 1) {
    const double sound = trial.equivalent / state.shear_share;
    strain =
        std::max(0.0, sound - factor * trial.equivalent - trial.carried * (1 / trial.share - 1)) / (3 * G);
    const double remaining = cracks.shear(state, factor);
    state.tensile_plastic_strain += (state.shear_left > 0 ? 1 - remaining : 1) * tensile_strain;
  } else if (state.shear_left == 0) {
    strain = opens ? trial.shape : slip / std::sqrt(3.);
  }
  if (strain > 0) {
    state.plastic_strain += strain;
    shear.add_flow(state.shear_damage, strain, surface.invariant_of(pressure), step.spacing);
  }
  cracks.keep_open(state, trial.strain - (state.opened - trial.opened), slip);
}

/// The bulk modulus of the current branch (0 while cracks open) and the shear stiffness of the
/// radial return at fixed pressure: 2 G S / q across the flow direction and 0 along it. The dependence of S
/// on pressure is left out because it is not symmetric. Shear is further scaled by the share of the strength
/// that shear damage has left, and both by 1 - d_t in tension: a cracked point must not be held together by
/// its stabilisation.
inline Stiffness Afc::stabilisation(const Trial& trial, const State& state, bool opens,
                                    const Strength& strength, double factor, double volume_ratio) const {
  const double soundness = trial.open ? 1 - state.tensile_damage : 1;
  Stiffness stiffness{.bulk = opens ? 0 : trial.modulus * soundness,
                      .shear = G * state.shear_share * soundness * strength.intact_share,
                      .limit = strength.stress};
  if (trial.open) stiffness.bulk *= state.bulk_left;
  // In tension the shear share above has fallen with what cracks have taken; what flows is still to be left
  // out.
  const bool cracked = trial.open && cracks.opening == Opening::cracks;
  stiffness.shear *= cracked ? cracks.remaining_share(factor) : factor;
  if (volumetric_strain == VolumetricStrain::density_ratio) stiffness.bulk /= volume_ratio;
  if (factor < 1) {
    stiffness.flow = stiffness.shear;
    stiffness.direction = std::sqrt(1.5) / trial.equivalent * trial.deviator;
  }
  return stiffness;
}

/// With mu = 1 / J - 1 the mean stress works d ln J = -d mu / (1 + mu), and K x^2 / 2 becomes
/// K (x - a ln(1 + x / a)): x = mu - a + 1 with a = 1 + mu where the faces touch. With a pressure cut-off
/// (Opening::cut_off) it is only what the present stress holds, without what a closing volume gives back.
inline StoredEnergy Afc::stored_energy(const Sym3& stress, const State& state) const {
  const Sym3 s = deviator(stress);
  const double pressure = -trace(stress) / 3, K = hydrostat.unloading_modulus(state.largest_compression) *
                                                  (pressure < 0 ? state.bulk_left : 1);
  StoredEnergy energy;
  if (state.shear_share > 0) energy.shape = contract(s, s) / (4 * G * state.shear_share);
  if (!(K > 0)) return energy;
  const double x = pressure / K;
  energy.volume = K * x * x / 2;
  if (volumetric_strain == VolumetricStrain::density_ratio) {
    const double a = 1 + hydrostat.plastic_strain(state.largest_compression) - state.opened;
    energy.volume = K * (x - a * std::log1p(x / a));
  }
  return energy;
}

} // namespace spall
