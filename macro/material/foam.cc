#include "macro/material/foam.h"

#include "shared/error.h"
#include "shared/input/quantity.h"

namespace spall {

Foam::Crushing Foam::crush(double e) const {
  double from = 0, pressure = 0, modulus = 0;
  for (std::size_t i = 0; i < strains.size(); ++i) {
    modulus = (pressures[i] - pressure) / (strains[i] - from);
    if (e <= strains[i] || i + 1 == strains.size()) break;
    from = strains[i], pressure = pressures[i];
  }
  return {pressure + modulus * (e - from), modulus};
}

Stiffness Foam::update(Sym3& stress, State& state, const StrainStep& step) const {
  const double e = -std::log(step.volume_ratio);
  const bool crushes = e > state.compaction;
  state.compaction = std::fmax(state.compaction, e);
  const auto [largest, modulus] = crush(state.compaction);
  const double p = largest - K * (state.compaction - e);

  if (p < -T) state.tensile_damage = 1;
  if (p < 0 && state.tensile_damage > 0) {
    stress = {};
    return {.limit = 0};
  }
  const Sym3 s = deviator(stress) + 2 * G * deviator(step.increment);
  const double q = equivalent_stress(s), most = strength(p), factor = q > most ? most / q : 1;
  stress = plus_spherical(factor * s, -p);
  state.plastic_strain += (1 - factor) * q / (3 * G);
  Stiffness stiffness{.bulk = crushes ? modulus : K, .shear = factor * G, .limit = most};
  if (factor < 1) stiffness.flow = stiffness.shear, stiffness.direction = std::sqrt(1.5) / q * s;
  return stiffness;
}

void Foam::declare(Parameters& parameters, Needed needed, const std::string& name_of_section) {
  auto section = parameters.section(name_of_section, std::move(needed));
  const Range positive{above_zero}, not_negative{0};
  section.quantity("Density", density, Dimension::density, positive, "of the undeformed material");
  section.quantity("Shear modulus", G, Dimension::stress, positive, "G");
  section.quantity("Unloading modulus", K, Dimension::stress, positive,
                   "bulk modulus K of unloading and reloading");
  section.number("a0", a0, not_negative,
                 "of the strength J2 <= a0 + a1 p + a2 p^2 at pressure p, in Pa^2: the square of the shear "
                 "strength without pressure");
  section.quantity("a1", a1, Dimension::stress, not_negative, "see a0");
  section.number("a2", a2, not_negative, "see a0");
  section.quantity("Tension cut-off", T, Dimension::stress, not_negative,
                   "mean tension at which the material separates");
  section.quantities("Strains", strains, Dimension::none, positive,
                     "of the crushing curve: volumetric strains -ln(V / V0), ascending; the curve starts at "
                     "0, 0 and goes on with its last slope");
  section.quantities("Pressures", pressures, Dimension::stress, positive,
                     "of the crushing curve, at the Strains, ascending");
  parameters.section(name_of_section, Needed::never())
      .quantity("Strength cap", cap, Dimension::stress, positive,
                "largest equivalent stress; if not set, there is none");
}

void Foam::validate(const std::string& file, const std::string& section) const {
  const auto refuse = [&](const std::string& key, const std::string& why) {
    throw InputError(file + ": key '" + section + "/" + key + "': " + why);
  };
  const auto number = [](double value) { return format_quantity(value, Dimension::none); };
  const auto stress = [](double value) { return format_quantity(value, Dimension::stress); };
  if (strains.empty()) refuse("Strains", "found none, must be set: at least one point of the crushing curve");
  if (strains.size() != pressures.size())
    refuse("Pressures", "found " + std::to_string(pressures.size()) + ", allowed: as many as Strains, " +
                            std::to_string(strains.size()));
  double from = 0, pressure = 0;
  for (std::size_t i = 0; i < strains.size(); ++i) {
    if (!(strains[i] > from))
      refuse("Strains", "found " + number(strains[i]) + " after " + number(from) + ", allowed: ascending");
    if (!(pressures[i] > pressure))
      refuse("Pressures",
             "found " + stress(pressures[i]) + " after " + stress(pressure) + ", allowed: ascending");
    const double slope = (pressures[i] - pressure) / (strains[i] - from);
    constexpr double round_off = 1e-9;
    if (slope > (1 + round_off) * K)
      refuse("Unloading modulus", "found " + stress(K) +
                                      ", allowed: at least every slope of the crushing curve, " +
                                      stress(slope));
    from = strains[i], pressure = pressures[i];
  }
  if (a1 < 2 * a2 * T)
    refuse("Tension cut-off", "found " + stress(T) + ", allowed: at most a1 / (2 a2), " +
                                  stress(a1 / (2 * a2)) + ", beyond which the strength grows with tension");
}

} // namespace spall
