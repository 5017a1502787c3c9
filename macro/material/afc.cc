#include "macro/material/afc.h"

#include "shared/error.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace spall {

/// kappa = max over time of r eps1: eps1 is the largest principal (logarithmic) strain, r = sum <s_i> / sum
/// |s_i| of the principal stresses the weight of Lee & Fenves (1998), which is 1 in pure tension and 0 in
/// pure compression, where Poisson's effect makes eps1 positive too. The stress is the one without tension
/// cut-off: of an open crack all that is left is the volume it has opened.
void Afc::grow_tensile_damage(State& state, const Sym3& stress, const Mat3& deformation) const {
  if (state.tensile_damage >= tensile->last) return;
  const double floor = std::max(state.tensile_strain, tensile->threshold + tensile->delay);

  // eps1 = ln(largest eigenvalue of F F^T) / 2 <= (mean + 2 p - 1) / 2 with Smith's p: most points stop here.
  const Sym3 b = times_transpose(deformation);
  const Sym3 s = deviator(b);
  if (trace(b) / 3 + 2 * std::sqrt(contract(s, s) / 6) - 1 <= 2 * floor) return;

  double pulling = 0, all = 0;
  for (const double value : principal_values(stress)) pulling += std::max(0.0, value), all += std::abs(value);
  const double kappa = pulling / all * std::log(largest_eigenvalue(b)) / 2;
  if (!(kappa > floor)) return;
  state.tensile_strain = kappa;
  state.tensile_damage = std::max(state.tensile_damage, tensile->law(kappa - tensile->delay));
}

void Afc::use(DamageLaw law) {
  surface.table_strength = law.strength_factor();
  const double threshold = law.threshold(), first = law(0), last = law(std::numeric_limits<double>::max());
  tensile =
      TensileDamage{std::move(law), threshold, (surface.tensile_rate_factor - 1) * threshold, first, last};
}

void Afc::load(double spacing) {
  if (tensile_law == TensileLaw::exponential)
    return use(DamageLaw::exponential(damage_threshold, damage_scale));
  if (!uses_table()) return;
  const DamageTable table = read_damage_table(damage_table);
  check_elastic_constants(table, youngs_modulus(), poisson_ratio(), "damage table '" + damage_table + "'");
  use(table, spacing);
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
      "Volumetric strain", volumetric_strain,
      {{"logarithmic", VolumetricStrain::logarithmic}, {"density ratio", VolumetricStrain::density_ratio}},
      "mu = -ln J, or density over initial density - 1");
  section.choice("Invariant", surface.invariant,
                 {{"mean stress", Invariant::mean_stress}, {"trace", Invariant::trace}},
                 "what I1 of Eqs. 22-24 and 30 means");
  section.quantity("Rate floor", surface.rate_floor, Dimension::rate, positive,
                   "smallest strain rate in 1 + C3 ln(rate s)");
  section.number(
      "Lode eccentricity", surface.lode_eccentricity, {0.5, 1},
      "Willam-Warnke: strength in extension over compression; 1 switches the effect off (the paper "
      "prints no value)");
  section.flag("Shear damage", shear_damage, "Eq. 24");
  section.number("Failure strain floor", failure_strain_floor, not_negative,
                 "smallest plastic strain to failure in Eq. 24, where D1 P vanishes; 0: as printed");
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
  section.number(
      "Tensile rate factor", surface.tensile_rate_factor, positive,
      "on T_max and on the strain where tensile damage starts; dissipation per crack area scales alike");
}

} // namespace spall
