#pragma once

#include "macro/material/concrete_tension.h"
#include "macro/material/cubic_pressure.h"
#include "macro/material/material.h"

#include <algorithm>
#include <cmath>

namespace spall {

/// What every concrete below remembers, besides the history of its pressure.
struct ConcreteState : ConcreteTension::State {
  double shear_damage = 0;   ///< D of the law
  double plastic_strain = 0; ///< effective, deviatoric
};

/// Trial pressure of a point, compression positive, without tension cut-off.
struct TrialPressure {
  double pressure, modulus; ///< Pa; modulus = dP / dmu
  double crushed;           ///< plastic volumetric strain of the step, compression positive
};

/// One step of a point of concrete that flows under pressure and cracks in tension, as Afc does; SI units,
/// tension positive, pressures and mu = 1 / J - 1 compression positive.
///
/// The pressure is a function of J and of the law's history. Pressed, the deviator is elastic, then returned
/// radially to the strength at that pressure. Pulled, what exceeds the limit of the mean tension, or the
/// strength, takes stiffness, and the point closes along the secant (Cracks, which states the free energy).
///
/// A Law has a State of its own, derived from ConcreteState, a shear modulus G, a ConcreteTension `tension`,
/// and these functions:
///   press(state, mu)                  updates the history of the pressure, returns TrialPressure
///   tension_limit(state, rate)        largest mean tension by the law's own equations, Pa
///   strength(state, P, limit, rate, s)  largest equivalent stress at pressure P, whose mean tension has this
///                                     limit, along the deviator s, Pa
///   harm(state, plastic, crushed, P, rate, s)  shear damage by plastic strain and crushed volume
/// `rate` is the equivalent deviatoric strain rate of the step, 1/s.
template<class Law> class ConcreteStep {
public:
  using State = typename Law::State;

  /// The trial state: pressure, and the deviator without strength.
  ConcreteStep(const Law& law_, const Sym3& stress, State& state_, const StrainStep& step_)
      : law(law_), tension(law_.tension), state(state_), step(step_), opened(state_.opened),
        trial(law_.press(state_, 1 / step_.volume_ratio - 1 + state_.opened)), open(trial.pressure < 0),
        strain(-trial.pressure / trial.modulus) {
    // An open point keeps its share of the deviator of a sound one, a closed one what it carries (Cracks).
    const Sym3 before = deviator(stress), de = deviator(step.increment);
    carried = equivalent_stress(before);
    share = state.shear_share;
    state.shear_share = open ? state.shear_left : 1;
    kept = !open ? 1 : share > 0 ? state.shear_share / share : 0;
    shape = std::sqrt(2. / 3 * contract(de, de));
    rate = shape / step.dt;
    s = kept * before + 2 * law.G * state.shear_share * de;
    equivalent = equivalent_stress(s);
  }

  /// Advances the stress and the state. Returns the stiffness for stabilisation, not the derivative of the
  /// stress.
  Stiffness finish(Sym3& stress) {
    const double tensile_strain = find_limit();
    const bool opens = tension.cracks.open(state, open, strain, trial.modulus, limit);
    const double strength = law.strength(state, pressure, limit, rate, s);
    const double factor = equivalent > strength ? strength / equivalent : 1;
    stress = plus_spherical(factor * s, -pressure);

    const bool cracking = tension.cracks.opening == Opening::cracks;
    double plastic = 0;
    if (factor < 1 && !(cracking && open)) {
      plastic = (1 - factor) * equivalent / (3 * law.G);
      state.tensile_plastic_strain += (1 - factor) * tensile_strain;
    }
    if (cracking && open) plastic = crack(factor, opens, tensile_strain);
    state.plastic_strain += plastic;
    if (plastic > 0 || trial.crushed > 0) law.harm(state, plastic, trial.crushed, pressure, rate, s);
    return stabilisation(opens, strength, factor);
  }

private:
  /// Sets the limit of the mean tension and the pressure that it leaves. With the damage table d_t grows
  /// first (Eq. 30 of AFC). Returns the strain of TensileDamage::Growth.
  double find_limit() {
    if (tension.own()) {
      cut(law.tension_limit(state, rate));
      return 0;
    }
    const TensileDamage& tensile = tension.tensile;
    const TensileDamage::Curve& curve = tensile.curve_at(step.spacing);
    tensile.begin(state, curve, trial.pressure, step);
    cut(tensile.limit(state, curve));
    const double strength = law.strength(state, pressure, limit, rate, s);
    const TensileDamage::Trial<double> pulled{.pressure = trial.pressure,
                                              .modulus = trial.modulus,
                                              .deviator = s,
                                              .equivalent = equivalent,
                                              .shear_modulus = law.G * state.shear_share,
                                              .return_factor =
                                                  equivalent > strength ? strength / equivalent : 1,
                                              .carried = kept * carried,
                                              .deformation = step.deformation,
                                              .spacing = step.spacing,
                                              .radius = step.radius,
                                              .volume_alone = true};
    const auto growth = tensile.grow(state, curve, pulled);
    if (growth.damaged) cut(tensile.limit(state, curve));
    return growth.strain;
  }
  /// An open point is in tension even if nothing is left of it: its strength is the one in tension.
  void cut(double limit_) {
    constexpr double least_tension = 1e-30;
    limit = limit_;
    pressure = open ? -std::max(least_tension, Cracks::mean_tension<double>(state, -trial.pressure, limit))
                    : trial.pressure;
  }

  /// Shear stiffness of an open point, and the opening that slip keeps. Returns what counts as plastic
  /// strain, as Afc::crack does.
  double crack(double factor, bool opens, double tensile_strain) {
    const double lost = 1 - state.shear_share, slip = Cracks::slip(lost * shape, trace(step.increment));
    const bool loses = factor < 1, loose = factor >= 1 && state.shear_left == 0;
    double plastic = 0;
    if (loses) {
      const double growth =
          equivalent / state.shear_share - factor * equivalent - (share > 0 ? carried * (1 / share - 1) : 0);
      plastic = std::max(0., growth) / (3 * law.G);
    }
    const double remaining = tension.cracks.shear(state, loses, factor);
    if (loses) state.tensile_plastic_strain += (state.shear_left > 0 ? 1 - remaining : 1) * tensile_strain;
    if (loose) plastic = opens ? shape : slip / std::sqrt(3.);
    tension.cracks.keep_open(state, state.shear_left == 0, strain - (state.opened - opened), slip);
    return plastic;
  }

  /// The bulk modulus of the present branch (0 while cracks open) and the shear modulus of the radial return,
  /// both reduced by the damages: a crushed or cracked point must not be held together by its stabilisation.
  Stiffness stabilisation(bool opens, double strength, double factor) const {
    const bool cracking = tension.cracks.opening == Opening::cracks;
    const double soundness = open ? 1 - state.tensile_damage : 1;
    const double remaining = cracking && open ? tension.cracks.remaining_share(factor) : factor;
    Stiffness stiffness{.bulk = opens ? 0 : trial.modulus * soundness / step.volume_ratio,
                        .shear = law.G * state.shear_share * soundness * (1 - state.shear_damage) * remaining,
                        .limit = strength};
    if (open) stiffness.bulk *= state.bulk_left;
    if (factor < 1) stiffness.flow = stiffness.shear, stiffness.direction = std::sqrt(1.5) / equivalent * s;
    return stiffness;
  }

  const Law& law;
  const ConcreteTension& tension;
  State& state;
  const StrainStep& step;
  double opened; ///< State::opened before the step
  TrialPressure trial;
  bool open;             ///< whether the point is in mean tension
  double strain;         ///< volumetric strain since the faces touched, e of Cracks
  double carried, share; ///< equivalent stress and shear_share before the step
  double kept;           ///< what opening leaves of the deviator before the step
  double shape, rate;    ///< equivalent deviatoric strain of the step; the same per time, 1/s
  Sym3 s;                ///< trial deviator, Pa
  double equivalent;     ///< its equivalent stress, Pa
  double limit = 0;      ///< of the mean tension, Pa
  double pressure = 0;   ///< after the tension limit, Pa
};

/// Free energy of the deviator, J/m^3 (Cracks).
inline double shape_energy(const Sym3& stress, const ConcreteState& state, double G) {
  const Sym3 s = deviator(stress);
  return state.shear_share > 0 ? contract(s, s) / (4 * G * state.shear_share) : 0;
}
/// Free energy of mean tension, J/m^3. @param modulus dP / dmu of a sound point where P = 0, Pa
/// @param plastic mu that remains without pressure
inline double tension_energy(double pressure, const ConcreteState& state, double modulus, double plastic) {
  const double K = modulus * state.bulk_left;
  return K > 0 ? linear_pressure_energy(K, pressure / K, 1 + plastic - state.opened) : 0;
}

} // namespace spall
