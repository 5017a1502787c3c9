#include "macro/material/concrete_tension.h"

#include "shared/error.h"

namespace spall {

void ConcreteTension::prepare(const std::vector<double>& spacings, double youngs_modulus,
                              double poisson_ratio, double strength) {
  tensile.rate.compressive_strength = strength;
  if (!own()) tensile.prepare(spacings, youngs_modulus, poisson_ratio);
}

void ConcreteTension::declare(Parameters::Section& section) {
  section.choice(
      "Tension", law, {{"own", Tension::own}, {"damage table", Tension::damage_table}},
      "what limits the mean tension: the law's own equations, with its shear damage; or the damage "
      "d_t of a microcell (Damage law, Damage table), which leaves the shear damage aside there");
  tensile.declare_damage(section);
  tensile.rate.declare_law(section);
  cracks.declare(section);
}

void ConcreteTension::validate(const std::string& file, const std::string& section) const {
  const auto refuse = [&](const std::string& allowed) {
    throw InputError(file + ": key '" + section + "/Damage table': found '" + tensile.table +
                     "', allowed: " + allowed);
  };
  if (own() && !tensile.table.empty()) refuse("none with Tension = own");
  if (!own() && tensile.law == TensileLaw::table && tensile.table.empty())
    refuse("a file, with Tension = damage table");
}

} // namespace spall
