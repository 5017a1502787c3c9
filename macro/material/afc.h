#pragma once

#include "macro/material/cracks.h"
#include "macro/material/failure_surface.h"
#include "macro/material/hydrostat.h"
#include "macro/material/material_law.h"
#include "macro/material/oriented_cracks.h"
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
  static constexpr bool ductile = false;

  double density = required; ///< kg/m^3
  double G = required;       ///< shear modulus, Pa
  VolumetricStrain volumetric_strain = VolumetricStrain::logarithmic;
  Hydrostat hydrostat;    ///< Eqs. 20 and 21
  FailureSurface surface; ///< Eqs. 22, 23 and 30
  ShearDamage shear;      ///< Eq. 24
  /// Whether cracks have directions: then the points are OrientedAfc, which has these constants.
  CrackModel crack_model = CrackModel::fixed;
  /// Of faces of a fixed crack that touch: ACI 318 has 1.4 for concrete cast in one piece, Eurocode 2 0.7 to
  /// 0.9 for rough joints (recalled).
  double crack_friction = 1;
  Cracks cracks;         ///< Eqs. 27 and 28
  TensileDamage tensile; ///< Eq. 30

  /// V: one point or several (lane_math.h).
  template<class V> struct StateOf : TensileDamage::StateOf<V> {
    V largest_compression = broadcast<V>(0); ///< largest mu so far
    V shear_damage = broadcast<V>(0);        ///< d of Eq. 24
    V plastic_strain = broadcast<V>(0);      ///< effective, deviatoric
  };
  using State = StateOf<double>;
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
  template<class V>
  StiffnessOf<V> update(Sym<V>& stress, StateOf<V>& state, const StrainStepOf<V>& step) const;

  /// Binds the keys of a section. `needed`: whether its constants must be set (default: always).
  void declare(Parameters& parameters, Needed needed = {}, const std::string& section = name);
  /// Checks what no single key can. @throws InputError, which names `file` and the key in `section`
  void validate(const std::string& file, const std::string& section = name) const;
  /// Makes the curves of tensile damage for points of these spacings (m). Call after reading the inputs.
  /// @throws InputError: the damage table is unreadable or not for this material in tension
  void prepare(const std::vector<double>& spacings) {
    tensile.prepare(spacings, youngs_modulus(), poisson_ratio());
  }
  bool softens() const { return true; } ///< shear damage and cracks take its strength
  bool needs_spacing() const { return tensile.uses_table(); }
  /// Largest stress difference, Pa: C5, at any strain rate, unless it is read to limit nothing.
  double strength_limit() const {
    return surface.bound == StrengthBound::nothing ? std::numeric_limits<double>::infinity() : surface.C5;
  }
  Description describe() const {
    return {{"damage_table", tensile.uses_table() ? tensile.table : std::string()}};
  }

  double compression(double volume_ratio) const { ///< mu at J
    return volumetric_strain == VolumetricStrain::logarithmic ? -std::log(volume_ratio)
                                                              : 1 / volume_ratio - 1;
  }
  /// Presses a point to mu: its largest compression so far, and the pressure (Eqs. 20 and 21).
  template<class V> Hydrostat::Response<V> press(StateOf<V>& state, const V& mu) const {
    state.largest_compression = larger(state.largest_compression, mu);
    return hydrostat(mu, state.largest_compression);
  }

private:
  /// Trial state of a step: predictor without strength and without tension cut-off.
  template<class V> struct Trial {
    V pressure, modulus; ///< P and dP / dmu of the hydrostat, Pa
    V opened;            ///< State::opened before the step
    V crushed;           ///< plastic volumetric strain of the step (compression positive)
    Mask<V> open;        ///< whether the point is in mean tension
    V strain;            ///< volumetric strain since the faces touched, e of Cracks
    Sym<V> deviator;     ///< with the shear stiffness that an open point has left, Pa
    V equivalent;        ///< equivalent stress of the deviator, Pa
    V carried, share;    ///< equivalent stress and State::shear_share before the step
    V kept;              ///< what opening leaves of the deviator before the step
    V shape;             ///< equivalent deviatoric strain of the step
    V rate;              ///< the same per time, 1/s
  };
  template<class V>
  Trial<V> predict(const Sym<V>& stress, StateOf<V>& state, const StrainStepOf<V>& step) const;

  using Curve = TensileDamage::Curve;
  template<class V> using Strength = FailureSurface::Strength<V>;
  template<class V>
  Strength<V> strength_at(const V& pressure, const Trial<V>& trial, const StateOf<V>& state,
                          const Curve& curve) const {
    const V lost = surface.lost_cohesion(state.shear_damage, state.tensile_damage, pressure);
    return surface(pressure, lost, tensile.limit(state, curve), trial.rate, trial.deviator);
  }
  /// Largest mean tension of the trial state, Pa: at which its largest principal stress is the limit, if that
  /// is limited (TensionLimit).
  template<class V> V mean_limit(const Trial<V>& trial, const StateOf<V>& state, const Curve& curve) const {
    const V limit = tensile.limit(state, curve);
    if (!any(trial.open)) return limit;
    const V mean = state.bulk_left * -trial.pressure;
    return select(trial.open, surface.limited_mean(mean, limit, trial.deviator), limit);
  }
  /// Pressure that the tension limit and the cracks so far leave of the trial pressure, Pa. That of an open
  /// point is below zero even if nothing is left of it: its strength is the one in tension, not the cohesion
  /// at P = 0.
  template<class V> V cracked_pressure(const Trial<V>& trial, const StateOf<V>& state, const V& limit) const {
    constexpr double least_tension = 1e-30;
    const V tension = larger(least_tension, Cracks::mean_tension<V>(state, -trial.pressure, limit));
    return select(trial.open, V(-tension), trial.pressure);
  }
  /// Strength over the equivalent stress of the trial state, at most 1: what the strength keeps of the
  /// deviator.
  template<class V> static V return_factor(const Trial<V>& trial, const Strength<V>& strength) {
    return select(trial.equivalent > strength.stress, V(strength.stress / trial.equivalent), 1);
  }
  /// Flow: plastic strain, and shear damage. @param flows which points do
  /// @param pressure after the tension limit, Pa
  template<class V>
  void flow(StateOf<V>& state, const Mask<V>& flows, const Trial<V>& trial, const V& factor,
            const V& pressure, const V& tensile_strain, double spacing) const;
  /// Cracking of open points: shear stiffness, the opening that slip keeps, and shear damage.
  template<class V>
  void crack(StateOf<V>& state, const Trial<V>& trial, const V& factor, const V& pressure,
             const Mask<V>& opens, const V& tensile_strain, const StrainStepOf<V>& step) const;

  template<class V>
  StiffnessOf<V> stabilisation(const Trial<V>& trial, const StateOf<V>& state, const Mask<V>& opens,
                               const Strength<V>& strength, const V& factor, double volume_ratio) const;
};

template<class V>
StiffnessOf<V> Afc::update(Sym<V>& stress, StateOf<V>& state, const StrainStepOf<V>& step) const {
  // (i) trial state: pressure of the hydrostat (Eqs. 20 and 21), predictor of the deviator
  const Trial<V> trial = predict(stress, state, step);

  // (ii) strength at the trial state, with the damages and the rate factor so far (Eqs. 22 and 23)
  const Curve& curve = tensile.curve_at(step.spacing);
  tensile.begin(state, curve, trial.pressure, step);
  V limit = mean_limit(trial, state, curve), pressure = cracked_pressure(trial, state, limit);
  Strength<V> strength = strength_at(pressure, trial, state, curve);

  // (iii) tensile damage, and the strength it leaves (Eq. 30). The weight of kappa is that of the stress
  // before: under mixed stress d_t is late by up to one step.
  const TensileDamage::Trial<V> pulled{.pressure = trial.pressure,
                                       .modulus = trial.modulus,
                                       .deviator = trial.deviator,
                                       .equivalent = trial.equivalent,
                                       .shear_modulus = G * state.shear_share,
                                       .return_factor = return_factor(trial, strength),
                                       .carried = trial.kept * trial.carried,
                                       .deformation = step.deformation,
                                       .spacing = step.spacing,
                                       .radius = step.radius,
                                       .volume_alone =
                                           surface.tension_limit != TensionLimit::principal_stress};
  const auto growth = tensile.grow(state, curve, pulled);
  if (any(growth.damaged)) {
    limit = mean_limit(trial, state, curve);
    pressure = cracked_pressure(trial, state, limit);
    strength = strength_at(pressure, trial, state, curve);
  }

  // (iv) stress: the volume opens beyond the tension limit, the deviator is returned to the failure surface
  const Mask<V> opens = cracks.open(state, trial.open, trial.strain, trial.modulus, limit);
  const V factor = return_factor(trial, strength);
  stress = plus_spherical(factor * trial.deviator, V(-pressure));

  // (v) history, with shear damage (Eq. 24)
  const bool cracking = cracks.opening == Opening::cracks;
  Mask<V> flows = factor < 1.;
  if (cracking) flows = flows & (trial.pressure >= 0.);
  if (any(flows)) flow(state, flows, trial, factor, pressure, growth.strain, step.spacing);
  if (cracking && any(trial.open)) crack(state, trial, factor, pressure, opens, growth.strain, step);
  shear.add_crushing(state.shear_damage, trial.crushed, hydrostat.C9);
  return stabilisation(trial, state, opens, strength, factor, step.volume_ratio);
}

template<class V>
Afc::Trial<V> Afc::predict(const Sym<V>& stress, StateOf<V>& state, const StrainStepOf<V>& step) const {
  Trial<V> trial;
  trial.opened = state.opened;
  const V mu = compression(step.volume_ratio) + state.opened, before = state.largest_compression;
  const auto [pressure, modulus] = press(state, mu);
  trial.crushed = broadcast<V>(0);
  if (any(mu > before))
    trial.crushed = hydrostat.plastic_strain(state.largest_compression) - hydrostat.plastic_strain(before);
  trial.pressure = pressure;
  trial.modulus = modulus;
  trial.open = pressure < 0.;
  trial.strain = -pressure / modulus;

  // An open point keeps its share of s0, a closed one what it carries (Cracks).
  const Sym<V> carried = deviator(stress), de = deviator(step.increment);
  trial.carried = equivalent_stress(carried);
  trial.share = state.shear_share;
  state.shear_share = select(trial.open, state.shear_left, 1);
  trial.kept = select(trial.open, select(trial.share > 0., V(state.shear_share / trial.share), 0), 1);
  trial.shape = square_root(V(2. / 3 * contract(de, de)));
  trial.rate = trial.shape / step.dt;
  trial.deviator = trial.kept * carried + 2 * G * state.shear_share * de;
  trial.equivalent = equivalent_stress(trial.deviator);
  return trial;
}

template<class V>
void Afc::flow(StateOf<V>& state, const Mask<V>& flows, const Trial<V>& trial, const V& factor,
               const V& pressure, const V& tensile_strain, double spacing) const {
  const V lost = select(flows, V(1 - factor), 0), strain = lost * trial.equivalent / (3 * G);
  state.plastic_strain += strain;
  state.tensile_plastic_strain += lost * tensile_strain;
  shear.add_flow(state.shear_damage, strain, surface.invariant_of(pressure), spacing);
}

/// What Eq. 24 counts as plastic strain is in tension what stays, and the growth of what cracks have added to
/// the strain of the deviator: q0 (1 - share) / 3 G with q0 the equivalent stress of s0. A point without
/// shear stiffness has no s0 any more: all of its strain counts while it opens further, and the slip of its
/// cracks otherwise.
template<class V>
void Afc::crack(StateOf<V>& state, const Trial<V>& trial, const V& factor, const V& pressure,
                const Mask<V>& opens, const V& tensile_strain, const StrainStepOf<V>& step) const {
  const V lost = 1 - state.shear_share, slip = Cracks::slip(V(lost * trial.shape), trace(step.increment));
  const Mask<V> loses = trial.open & (factor < 1.),
                loose = trial.open & (factor >= 1.) & (state.shear_left == 0.);
  const V sound = trial.equivalent / state.shear_share;
  const V growth =
      larger(0, V(sound - factor * trial.equivalent - trial.carried * (1 / trial.share - 1))) / (3 * G);
  const V remaining = cracks.shear(state, loses, factor);
  const V stays = select(state.shear_left > 0., V(1 - remaining), 1);
  state.tensile_plastic_strain += select(loses, V(stays * tensile_strain), 0);
  const V of_loose = select(opens, trial.shape, V(slip / std::sqrt(3.)));
  const V strain = select(loses, growth, select(loose, of_loose, 0));
  state.plastic_strain += strain;
  shear.add_flow(state.shear_damage, strain, surface.invariant_of(pressure), step.spacing);
  cracks.keep_open(state, trial.open & (state.shear_left == 0.),
                   V(trial.strain - (state.opened - trial.opened)), slip);
}

/// The bulk modulus of the current branch (0 while cracks open) and the shear stiffness of the
/// radial return at fixed pressure: 2 G S / q across the flow direction and 0 along it. The dependence of S
/// on pressure is left out because it is not symmetric. Shear is further scaled by the share of the strength
/// that shear damage has left, and both by 1 - d_t in tension: a cracked point must not be held together by
/// its stabilisation.
template<class V>
StiffnessOf<V> Afc::stabilisation(const Trial<V>& trial, const StateOf<V>& state, const Mask<V>& opens,
                                  const Strength<V>& strength, const V& factor, double volume_ratio) const {
  const V soundness = select(trial.open, V(1 - state.tensile_damage), 1);
  StiffnessOf<V> stiffness{.bulk = select(opens, 0, V(trial.modulus * soundness)),
                           .shear = G * state.shear_share * soundness * strength.intact_share,
                           .limit = strength.stress};
  stiffness.bulk *= select(trial.open, state.bulk_left, 1);
  // In tension the shear share above has fallen with what cracks have taken; what flows is still to be left
  // out.
  const V remaining =
      cracks.opening == Opening::cracks ? select(trial.open, cracks.remaining_share(factor), factor) : factor;
  stiffness.shear *= remaining;
  if (volumetric_strain == VolumetricStrain::density_ratio) stiffness.bulk /= volume_ratio;
  stiffness.flow = select(factor < 1., stiffness.shear, 0);
  stiffness.direction = select(factor < 1., V(std::sqrt(1.5) / trial.equivalent), 0) * trial.deviator;
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
