#include "macro/material/tensile_damage.h"

#include "macro/points/tensor.h"
#include "shared/error.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace spall {

double TensileDamage::weight_of(const Vec3& principal) const {
  if (weight == DamageWeight::none) return 1;
  double positive = 0, all = 0;
  for (const double value : principal) positive += std::max(0.0, value), all += std::abs(value);
  return positive / all;
}

double TensileDamage::width_of_crack(const State& state, const Trial<double>& trial) const {
  constexpr double no_stress =
      1e-9; // of T_max: a point that has lost its shear stiffness keeps its direction
  if (!(trial.equivalent > no_stress * T_max)) return state.crack_width;
  const Sym3& s = trial.deviator;
  const double hoop = s[1], in_plane = 0.5 * (s[0] + s[2]) +
                                       std::hypot(0.5 * (s[0] - s[2]), s[5]); // largest across the ring
  return hoop < in_plane ? 1 : width_of_radial_crack(trial.radius, trial.spacing);
}

double TensileDamage::width_of_radial_crack(double radius, double spacing) const {
  if (!(radial_cracks > 0) || !(radius > 0) || !(spacing > 0)) return 1;
  return std::max(1.0, 2 * std::numbers::pi * radius / radial_cracks / (crack_band * spacing));
}

double TensileDamage::total_strain(const Sym3& stress, const Mat3& deformation, double floor) const {
  // eps1 = ln(largest eigenvalue of F F^T) / 2 <= (mean + 2 p - 1) / 2 with Smith's p: most points stop here.
  const Sym3 b = times_transpose(deformation);
  const Sym3 s = deviator(b);
  if (trace(b) / 3 + 2 * std::sqrt(contract(s, s) / 6) - 1 <= 2 * floor) return 0;
  return weight_of(principal_values(stress)) * std::log(largest_eigenvalue(b)) / 2;
}

double TensileDamage::tension_strain(const State& state, const Curve& curve, const Trial<double>& trial,
                                     double floor, double& along) const {
  if (!(largest_tension_strain(state, curve, trial) > floor)) return 0;
  const double undamaged_limit = limit(curve.first, state.tensile_rate_factor * curve.strength);
  // Mean tension if the point could close again; beyond the limit it is an opening.
  const double mean_tension = trial.modulus * state.opened - trial.pressure;
  const double elastic_mean = trial.volume_alone ? std::min(mean_tension, undamaged_limit) : mean_tension;
  const double mean = elastic_mean / (3 * trial.modulus);
  const double opening = std::max(0.0, mean_tension - elastic_mean) / trial.modulus;
  const double shear = 2 * trial.shear_modulus; // of the predictor; 0 if the point is open and has none left
  Vec3 principal = principal_values(trial.deviator);
  const double largest = principal[0];
  for (double& value : principal) value = trial.return_factor * value - trial.pressure;
  if (!(principal[0] > 0)) return 0; // round-off
  const double r = weight_of(principal);
  // What flows away in this step moves from the elastic part to the plastic one. A point that opens in this
  // step has no strength against a change of shape: only what it carried counts, the rest is the opening.
  const double elastic = shear > 0 ? r * largest / shear : 0;
  along = elastic;
  if (trial.volume_alone && !(-trial.pressure <= limit(state, curve)) && trial.equivalent > 0)
    along = elastic * std::min(1.0, trial.carried / trial.equivalent);
  return state.tensile_plastic_strain + r * (mean + opening) + trial.return_factor * elastic +
         (1 - trial.return_factor) * along;
}

/// kappa = max over time of r eps1 (total), or of r eps1 + plastic part (tensile). The weight r is 1 in pure
/// tension and 0 in pure compression, where Poisson's effect makes eps1 positive too. The stress is the one
/// without tension cut-off: the cut-off leaves nothing of an open crack but the volume it has opened.
TensileDamage::Growth<double> TensileDamage::grow(State& state, const Curve& curve,
                                                  const Trial<double>& trial) const {
  Growth<double> growth;
  if (state.tensile_damage >= curve.last) return growth;
  const Sym3 stress = plus_spherical(trial.return_factor * trial.deviator, -trial.pressure);
  if (is_compressive(stress)) return growth;
  const double floor = threshold_of(state, curve);
  const double kappa = strain == DamageStrain::total
                           ? total_strain(stress, trial.deformation, floor)
                           : tension_strain(state, curve, trial, floor, growth.strain);
  if (kappa > floor) {
    const double before = state.tensile_damage;
    state.tensile_strain = kappa;
    state.crack_width = width_of_crack(state, trial);
    state.tensile_damage =
        std::max(before, curve.damage(rate.static_strain(kappa, curve.threshold, state.tensile_rate_factor,
                                                         before, state.crack_width)));
    growth.damaged = state.tensile_damage > before;
  }
  return growth;
}

void TensileDamage::add(const DamageLaw& damage, double spacing) {
  curves.push_back({.spacing = spacing,
                    .damage = damage,
                    .strength = damage.strength_factor(),
                    .threshold = damage.threshold(),
                    .first = damage(0),
                    .last = damage(std::numeric_limits<double>::max())});
}

void TensileDamage::use(const DamageTable& made, std::vector<double> spacings) {
  // One curve serves spacings that differ by less than 2 %: its work per crack area is off by as much at
  // most.
  std::sort(spacings.begin(), spacings.end());
  curves.clear();
  for (const double spacing : spacings)
    if (curves.empty() || spacing > 1.02 * curves.back().spacing)
      add(DamageLaw(made, crack_band * spacing, definition), spacing);
}

void TensileDamage::prepare(const std::vector<double>& spacings, double youngs_modulus,
                            double poisson_ratio) {
  curves.clear();
  if (law == TensileLaw::exponential) return add(DamageLaw::exponential(threshold, scale), 0);
  if (!uses_table()) return;
  const DamageTable made = read_damage_table(table);
  const std::string where = "damage table '" + table + "'";
  check_tension(made, where);
  check_elastic_constants(made, youngs_modulus, poisson_ratio, where);
  use(made, spacings);
  for (const Curve& curve : curves)
    if (!(curve.last > curve.first))
      throw InputError(where + ": the cell under " + made.loading + ": found no growth of the damage that " +
                       "'Damage definition' chooses, from " + format_quantity(curve.first, Dimension::none) +
                       " to " + format_quantity(curve.last, Dimension::none) +
                       ", allowed: growth; pull the cell further, until it softens");
}

void TensileDamage::declare(Parameters::Section& section) {
  section.quantity("T_max", T_max, Dimension::stress, {above_zero},
                   "largest tensile pressure, Eq. 23: limits the mean stress, whatever Invariant says");
  declare_damage(section);
  rate.declare(section);
}

void TensileDamage::declare_damage(Parameters::Section& section) {
  const Range positive{above_zero}, not_negative{0};
  section.choice("Damage law", law, {{"table", TensileLaw::table}, {"exponential", TensileLaw::exponential}},
                 "d_t of Eq. 30: from the damage table, or 1 - exp(-(kappa - threshold) / scale) at any "
                 "spacing (not regularised: for verification only; the table is then not read)");
  section.file("Damage table", table,
               "made by microcell from a cell that was pulled; empty: no tensile damage (original AFC)");
  section.number("Damage threshold", threshold, not_negative, "kappa where the exponential law starts");
  section.number("Damage scale", scale, positive, "of the exponential law");
  section.choice("Damage definition", definition,
                 {{"strength", DamageDefinition::strength},
                  {"stiffness", DamageDefinition::stiffness},
                  {"stiffness renormalised", DamageDefinition::stiffness_renormalised}},
                 "which damage of the table is d_t of Eq. 30: the one that dissipates the cell's fracture "
                 "energy, or the loss of stiffness");
  section.choice("Damage strain", strain,
                 {{"total", DamageStrain::total}, {"tensile", DamageStrain::tensile}},
                 "kappa from the largest principal strain of the whole deformation, or from what tension has "
                 "strained");
  section.choice(
      "Damage weight", weight, {{"Lee Fenves", DamageWeight::lee_fenves}, {"none", DamageWeight::none}},
      "share of kappa's strain that counts under mixed stress: sum <s_i> / sum |s_i|, or all of it");
  section.number(
      "Crack band", crack_band, positive,
      "spacings over which the approximation spreads a crack: d_t is that of a cell of this size; 2 "
      "with supports of less than two spacings, 1 for a single point by itself");
  section.number("Radial cracks", radial_cracks, not_negative,
                 "with rotational symmetry: cracks along a radius, all around the axis, that hoop tension "
                 "opens; 0: one in "
                 "every crack band of the circumference");
}

} // namespace spall
