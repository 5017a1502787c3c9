#include "macro/material/afc.h"

#include "shared/error.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace spall {

/// r of the principal stresses, at least one of which is positive.
double Afc::weight(const Vec3& principal) const {
  if (damage_weight == DamageWeight::none) return 1;
  double pulling = 0, all = 0;
  for (const double value : principal) pulling += std::max(0.0, value), all += std::abs(value);
  return pulling / all;
}

/// kappa = max over time of r eps1 (total) or of r eps1 + plastic part (tensile). The weight r is 1 in pure
/// tension and 0 in pure compression, where Poisson's effect makes eps1 positive too. The stress is the one
/// without tension cut-off: of an open crack all that is left is the volume it has opened.
double Afc::grow_tensile_damage(State& state, const TensileDamage& law, const Pull& pull,
                                const Mat3& deformation) const {
  if (state.tensile_damage >= law.last) return 0;
  Sym3 stress;
  for (int i = 0; i < 6; ++i) stress[i] = pull.kept * pull.trial[i] - (i < 3 ? pull.pressure : 0);
  if (is_compressive(stress)) return 0;
  const double delay = (state.tensile_rate_factor - 1) * law.threshold;
  const double floor = std::max(state.tensile_strain, law.threshold + delay);

  double kappa, along = 0;
  if (damage_strain == DamageStrain::total) {
    // eps1 = ln(largest eigenvalue of F F^T) / 2 <= (mean + 2 p - 1) / 2 with Smith's p: most points stop
    // here.
    const Sym3 b = times_transpose(deformation);
    const Sym3 s = deviator(b);
    if (trace(b) / 3 + 2 * std::sqrt(contract(s, s) / 6) - 1 <= 2 * floor) return 0;
    kappa = weight(principal_values(stress)) * std::log(largest_eigenvalue(b)) / 2;
  } else {
    const double apart = pull.modulus * pull.opened - pull.pressure; // as if it could close again
    const double mean = std::min(apart, pull.first_limit) / (3 * pull.modulus);
    const double opening = std::max(0.0, apart - pull.first_limit) / pull.modulus;
    // The largest principal deviator is at most 2/3 of the equivalent stress: most points stop here.
    if (pull.kept == 1 && state.tensile_plastic_strain + opening + mean + pull.equivalent / (3 * G) <= floor)
      return 0;
    auto principal = principal_values(pull.trial);
    const double largest = principal[0];
    for (double& value : principal) value = pull.kept * value - pull.pressure;
    if (!(principal[0] > 0)) return 0; // round-off
    const double r = weight(principal);
    // What flows away in this step moves from the elastic part to the plastic one. A point that is open has
    // no strength against a change of shape: only what it still carried counts, or closing would, too.
    const double elastic = r * largest / (2 * G);
    along = -pull.pressure <= pull.limit ? elastic : elastic * std::min(1.0, pull.carried / pull.equivalent);
    kappa =
        state.tensile_plastic_strain + r * (mean + opening) + pull.kept * elastic + (1 - pull.kept) * along;
  }
  if (kappa > floor) {
    state.tensile_strain = kappa;
    state.tensile_damage = std::max(state.tensile_damage, law.law(kappa - delay));
  }
  return along;
}

void Afc::add(const DamageLaw& law, double spacing) {
  tensile.push_back({.spacing = spacing,
                     .law = law,
                     .strength = law.strength_factor(),
                     .threshold = law.threshold(),
                     .first = law(0),
                     .last = law(std::numeric_limits<double>::max())});
}

void Afc::use(const DamageTable& table, std::vector<double> spacings) {
  // One law serves spacings that differ by less than 2 %: its work per crack area is off by as much at most.
  std::sort(spacings.begin(), spacings.end());
  tensile.clear();
  for (const double spacing : spacings)
    if (tensile.empty() || spacing > 1.02 * tensile.back().spacing)
      add(DamageLaw(table, spacing, damage_definition), spacing);
}

void Afc::load(const std::vector<double>& spacings) {
  tensile.clear();
  if (tensile_law == TensileLaw::exponential)
    return add(DamageLaw::exponential(damage_threshold, damage_scale), 0);
  if (!uses_table()) return;
  const DamageTable table = read_damage_table(damage_table);
  check_elastic_constants(table, youngs_modulus(), poisson_ratio(), "damage table '" + damage_table + "'");
  use(table, spacings);
}

void Afc::validate(const std::string& file) const {
  const auto refuse = [&](const std::string& key, double found, Dimension dimension,
                          const std::string& allowed) {
    throw InputError(file + ": key 'AFC/" + key + "': found '" + format_quantity(found, dimension) +
                     "', allowed: " + allowed);
  };
  if (!(hydrostat.C9 > hydrostat.C7)) refuse("C9", hydrostat.C9, Dimension::none, "> C7");
  if (!(hydrostat.C8 >= bulk_modulus()))
    refuse("C8", hydrostat.C8, Dimension::stress,
           ">= C6 / C7 = " + format_quantity(bulk_modulus(), Dimension::stress));
  if (!(surface.C1 > surface.C2)) refuse("C1", surface.C1, Dimension::stress, "> C2");
}

void Afc::declare(Parameters& parameters, std::function<bool()> needed) {
  auto section = parameters.section("AFC", std::move(needed));
  const Range positive{above_zero}, not_negative{0};
  const auto pressure = [&](const std::string& key, double& variable, const std::string& help) {
    section.quantity(key, variable, Dimension::stress, positive, help);
  };
  section.quantity("Density", density, Dimension::density, positive, "of the undeformed material");
  pressure("Shear modulus", G, "G");
  pressure("C1", surface.C1, "failure surface, Eq. 22");
  pressure("C2", surface.C2, "failure surface, Eq. 22");
  section.number("C3", surface.C3, not_negative, "strain rate effect, Eq. 22");
  section.number("C4", surface.C4, not_negative, "linear term of the failure surface, Eq. 22");
  pressure("C5", surface.C5, "largest principal stress difference");
  pressure("C6", hydrostat.C6, "pressure where crushing begins");
  section.number("C7", hydrostat.C7, positive, "volumetric strain where crushing begins");
  pressure("C8", hydrostat.C8, "locking modulus");
  section.number("C9", hydrostat.C9, positive, "volumetric strain at locking");
  section.quantity("K1", hydrostat.K1, Dimension::stress, {}, "crushing curve, Eq. 21");
  section.quantity("K2", hydrostat.K2, Dimension::stress, {}, "crushing curve, Eq. 21");
  section.quantity("K3", hydrostat.K3, Dimension::stress, {}, "crushing curve, Eq. 21");
  section.quantity("D1", D1, Dimension::inverse_stress, not_negative, "shear damage, Eq. 24");
  section.quantity("A_N", surface.A_N, Dimension::inverse_stress, not_negative, "failure surface, Eq. 22");
  pressure("T_max", surface.T_max, "largest tensile pressure, Eq. 23");

  section.choice("Hydrostat", hydrostat.form,
                 {{"shifted", HydrostatForm::shifted}, {"printed", HydrostatForm::printed}},
                 "Eq. 21 in mu - C7 from the point (C7, C6), or as printed (not continuous)");
  section.choice(
      "Unloading", hydrostat.unloading,
      {{"interpolated", Unloading::interpolated}, {"elastic", Unloading::elastic}},
      "bulk modulus below the largest compression: from C6 / C7 at C7 to C8 at C9, or C6 / C7 up to "
      "C9 and C8 beyond");
  section.choice(
      "Volumetric strain", volumetric_strain,
      {{"logarithmic", VolumetricStrain::logarithmic}, {"density ratio", VolumetricStrain::density_ratio}},
      "mu = -ln J, or density over initial density - 1");
  section.choice("Invariant", surface.invariant,
                 {{"mean stress", Invariant::mean_stress}, {"trace", Invariant::trace}},
                 "what I1 of Eqs. 22-24 and 30 means");
  section.quantity("Rate floor", surface.rate_floor, Dimension::rate, positive,
                   "smallest strain rate in 1 + C3 ln(rate s)");
  section.choice("C5 limits", surface.bound,
                 {{"equivalent stress", StrengthBound::equivalent_stress},
                  {"principal difference", StrengthBound::principal_difference},
                  {"nothing", StrengthBound::nothing}},
                 "what C5 bounds: the strength as min(S, C5), the principal stress difference as printed, or "
                 "nothing");
  section.number(
      "Lode eccentricity", surface.lode_eccentricity, {0.5, 1},
      "Willam-Warnke: strength in extension over compression at P = 0; 1 switches the effect off (the paper "
      "prints no value)");
  section.quantity("Lode fading pressure", surface.lode_fading, Dimension::stress, not_negative,
                   "where the eccentricity has risen to 1, linearly from P = 0; 0: it does not");
  section.choice("Lode range", surface.lode_range,
                 {{"everywhere", LodeRange::everywhere}, {"compression", LodeRange::compression}},
                 "whether it reduces the tensile surface as well, which keeps the two continuous, or Eq. 22 "
                 "alone");
  section.number("Opened volume kept", opened_kept, {0, 1},
                 "part of the volume opened beyond the tension cut-off that stays: 0 closes before pressure "
                 "returns, as a crack does; 1 stays, as in rubble that no longer fits");
  section.number("Crack dilatancy", crack_dilatancy, not_negative,
                 "opening over slip where a rough crack that has slipped touches again: so much of what has "
                 "opened stays; 0: slip keeps nothing open");
  section.flag("Shear damage", shear_damage, "Eq. 24");
  section.choice("Shear damage acts in", shear_damage_side,
                 {{"compression and tension", DamageSide::both}, {"compression", DamageSide::own}},
                 "sides of P = 0 where it takes the cohesion: both, as Eqs. 22 and 30 are printed, or "
                 "compression alone");
  section.choice(
      "Tensile damage acts in", tensile_damage_side,
      {{"tension", DamageSide::own}, {"compression and tension", DamageSide::both}},
      "Eq. 30 as printed: it takes the mean tension, and a cracked point has its cohesion back under "
      "pressure; or it takes the cohesion as well, on both sides of P = 0");
  section.number("Failure strain floor", failure_strain_floor, not_negative,
                 "smallest plastic strain to failure in Eq. 24, where D1 P vanishes; 0: as printed");
  section.quantity("Shear damage reference length", shear_reference, Dimension::length, not_negative,
                   "spacing that the strain to failure of Eq. 24 belongs to; at another one it is scaled "
                   "inversely, so that a shear band dissipates the same per area; 0: never scaled");
  section.choice(
      "Damage law", tensile_law, {{"table", TensileLaw::table}, {"exponential", TensileLaw::exponential}},
      "d_t of Eq. 30: from the damage table, or 1 - exp(-(kappa - threshold) / scale) at any spacing (not "
      "regularised: for verification only; the table is then not read)");
  section.file("Damage table", damage_table, "made by microcell; empty: no tensile damage (original AFC)");
  section.number("Damage threshold", damage_threshold, not_negative,
                 "kappa where the exponential law starts");
  section.number("Damage scale", damage_scale, positive, "of the exponential law");
  section.choice(
      "Damage definition", damage_definition,
      {{"strength", DamageDefinition::strength},
       {"stiffness", DamageDefinition::stiffness},
       {"stiffness renormalised", DamageDefinition::stiffness_renormalised}},
      "which damage of the table is d_t of Eq. 30: the one that dissipates the cell's fracture energy, "
      "or the loss of stiffness");
  section.choice("Damage strain", damage_strain,
                 {{"total", DamageStrain::total}, {"tensile", DamageStrain::tensile}},
                 "kappa from the largest principal strain of the whole deformation, or from what tension has "
                 "strained");
  section.choice(
      "Damage weight", damage_weight,
      {{"Lee Fenves", DamageWeight::lee_fenves}, {"none", DamageWeight::none}},
      "share of kappa's strain that counts under mixed stress: sum <s_i> / sum |s_i|, or all of it");
  section.choice("Tensile rate law", tensile_rate.law,
                 {{"constant", TensileRateLaw::constant},
                  {"Malvar Crawford", TensileRateLaw::malvar_crawford},
                  {"CEB 1990", TensileRateLaw::ceb_1990},
                  {"fib 2010", TensileRateLaw::fib_2010}},
                 "growth of T_max, and of the strain where tensile damage starts, with the strain rate; "
                 "dissipation per crack area scales alike");
  section.number("Tensile rate factor", tensile_rate.constant, positive, "of the constant law");
  pressure("Compressive strength", tensile_rate.compressive_strength,
           "nominal, for the rate laws of Malvar and Crawford and of CEB");
}

} // namespace spall
