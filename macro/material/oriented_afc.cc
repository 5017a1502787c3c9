#include "macro/material/oriented_afc.h"

#include <algorithm>
#include <cmath>

namespace spall {

OrientedAfc::OrientedAfc(const Afc& constants)
    : afc(constants), cracks{.model = constants.crack_model,
                             .kept = constants.cracks.opened_kept,
                             .dilatancy = constants.cracks.dilatancy,
                             .friction = constants.crack_friction},
      strength(constants.surface), density(constants.density) {
  strength.tension_limit = TensionLimit::mean_stress; // the cracks limit the tension themselves
}

/// Limits of the tension across the cracks, Pa.
void OrientedAfc::limit_tension(State& state, const TensileDamage::Curve& curve) const {
  const double cohesion = (strength.C1 - strength.C2) * (1 - state.shear_damage);
  for (std::size_t i = 0; i < 3; ++i)
    state.limit[i] = std::min(cohesion, afc.tensile.limit(std::max(state.damage[i], curve.first),
                                                          state.tensile_rate_factor * curve.strength));
}

/// Whether the point has cracks or its trial stress may open one, with the limits at their rate. The rate of
/// a sound point is that of its largest extension: tests are rated by that, whatever is pressed beside it.
/// Cracks keep the factor of the step in which the first has opened.
bool OrientedAfc::may_crack(State& state, const TensileDamage::Curve& curve, const Sym3& stress,
                            const StrainStep& step) const {
  const TensileRate& rate = afc.tensile.rate;
  if (!state.cracked()) state.tensile_rate_factor = rate.is_constant() ? rate.constant : 1;
  limit_tension(state, curve);
  if (state.cracked()) return true;
  // The largest principal stress is at most 2/3 of the equivalent stress plus the mean.
  if (!(2. / 3 * equivalent_stress(deviator(stress)) + trace(stress) / 3 > state.limit[0])) return false;
  if (!rate.is_constant()) {
    state.tensile_rate_factor = rate(std::max(0., largest_eigenvalue(step.increment)) / step.dt);
    limit_tension(state, curve);
  }
  return largest_eigenvalue(stress) > state.limit[0];
}

/// Raises d_t of cracks that have opened: kappa of a cell with the same crack (TensileRate::static_strain).
void OrientedAfc::damage(State& state, const TensileDamage::Curve& curve, const StrainStep& step) const {
  const double R = state.tensile_rate_factor;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(state.largest[i] > 0) || state.damage[i] >= curve.last) continue;
    const double before = std::max(state.damage[i], curve.first),
                 elastic = R * curve.threshold * (1 - before);
    const double hoop = state.normals(static_cast<int>(i), 1);
    const double width = afc.tensile.width_of_radial_crack(hoop * hoop > 0.5 ? step.radius : 0, step.spacing);
    const double kappa =
        afc.tensile.rate.static_strain(elastic + state.largest[i], curve.threshold, R, before, width);
    state.damage[i] = std::max(before, curve.damage(kappa));
    state.tensile_damage = std::max(state.tensile_damage, state.damage[i]);
    state.tensile_strain = std::max(state.tensile_strain, elastic + state.largest[i]);
  }
  if (cracks.model == CrackModel::rotating)
    state.damage = {state.tensile_damage, state.tensile_damage, state.tensile_damage};
}

Stiffness OrientedAfc::update(Sym3& stress, State& state, const StrainStep& step) const {
  const double G = afc.G;
  // (i) pressure of the concrete between the cracks as they were (Eqs. 20 and 21)
  const double solid_before = state.solid_share();
  state.swelling += step.swelling;
  const double mu = afc.compression(step.volume_ratio) - state.swelling, before = state.largest_compression;
  // The largest compression is kept for the final openings: that before a crack has opened crushes nothing.
  const auto press = [&](double opened) { return afc.hydrostat(mu + opened, std::max(before, mu + opened)); };
  Hydrostat::Response<double> concrete = press(state.opened);
  const Sym3 carried = 1 / solid_before * deviator(stress), de = deviator(step.increment);
  const double rate = std::sqrt(2. / 3 * contract(de, de)) / step.dt;

  // (ii) tension across cracks
  const TensileDamage::Curve& curve = afc.tensile.curve_at(step.spacing);
  bool opens = false;
  Sym3 s = carried + 2 * G * de;
  /// Moves the cracks after a stress in the axes of their normals. Returns it in those of the body.
  const auto follow = [&](Sym3 s_in_axes) {
    concrete = cracks.move(state, s_in_axes, press, G);
    state.opened = state.total_opening();
    opens = cracks.widen(state) || opens;
    state.plastic_strain += cracks.settle(state, s_in_axes, concrete.pressure, G);
    return rotate(transpose(state.normals), s_in_axes);
  };
  if (may_crack(state, curve, plus_spherical(s, -concrete.pressure), step)) {
    if (step.rotation) state.normals = multiply(state.normals, transpose(*step.rotation));
    s = follow(cracks.trial(state, carried, de, G));
    cracks.keep_open(state, rotate(state.normals, de));
  }
  // (iii) strength of the concrete between them (Eq. 22), with shear damage (Eq. 24)
  const double pressed = std::max(0., concrete.pressure);
  const double lost = strength.lost_cohesion(state.shear_damage, state.tensile_damage, pressed);
  const double largest = strength(pressed, lost, afc.tensile.T_max, rate, s).stress;
  const double equivalent = equivalent_stress(s), factor = equivalent > largest ? largest / equivalent : 1;
  Sym3 left = factor * s;
  if (factor < 1 && state.cracked()) {
    // The tension that balanced the pressure across an open crack has flowed away: it closes by what is
    // missing. Left under pressure while it opens further, it would do work that nothing has stored.
    left = follow(rotate(state.normals, left));
  }
  if (state.cracked()) damage(state, curve, step);
  state.largest_compression = std::max(before, mu + state.opened);
  stress = state.solid_share() * plus_spherical(left, -concrete.pressure);
  if (factor < 1) {
    const double plastic = (1 - factor) * equivalent / (3 * G);
    state.plastic_strain += plastic;
    afc.shear.add_flow(state.shear_damage, plastic, strength.invariant_of(pressed), step.spacing);
  }
  afc.shear.add_crushing(state.shear_damage,
                         afc.hydrostat.plastic_strain(state.largest_compression) -
                             afc.hydrostat.plastic_strain(before),
                         afc.hydrostat.C9);

  // (iv) stiffness for stabilisation: what the weakest direction has
  double share = 1;
  for (std::size_t i = 0; i < 3; ++i)
    share = std::min(share, 1 / (1 + (concrete.modulus + 4. / 3 * G) * state.compliance(i)));
  Stiffness stiffness{.bulk = opens ? 0 : concrete.modulus * share,
                      .shear = G * share * (1 - state.shear_damage) * factor,
                      .limit = state.cracked() ? 0 : largest};
  if (factor < 1) stiffness.flow = stiffness.shear, stiffness.direction = std::sqrt(1.5) / equivalent * s;
  return stiffness;
}

StoredEnergy OrientedAfc::stored_energy(const Sym3& stress, const State& state) const {
  const double share = state.solid_share();
  const Sym3 between = 1 / share * stress;
  StoredEnergy energy = afc.stored_energy(between, state);
  energy.shape += OrientedCracks::energy(state, between, afc.G);
  return {.volume = share * energy.volume, .shape = share * energy.shape};
}

} // namespace spall
