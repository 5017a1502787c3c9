#include "macro/material/afc.h"

#include "shared/error.h"
#include "shared/input/quantity.h"

#include <algorithm>
#include <cmath>

namespace spall {
namespace {

/// The paper to the letter. What it prints no equation for has no effect here: no strain to failure below
/// that of Eq. 24, no scaling with the spacing, no band of a crack, no rate effect on T_max, nothing that
/// keeps a crack open, no weight of kappa. It says that the Lode effect reduces Eq. 22 but prints no
/// eccentricity: that stays ours, as do mu against J and the rate floor, which the paper does not define.
const Parameters::Preset as_printed = {{"Hydrostat", "printed"},
                                       {"Unloading", "elastic"},
                                       {"Invariant", "trace"},
                                       {"C5 limits", "principal difference"},
                                       {"Lode fading pressure", "0 MPa"},
                                       {"Lode range", "compression"},
                                       {"Shear damage acts in", "compression and tension"},
                                       {"Tensile damage acts in", "tension"},
                                       {"Failure strain floor", "0"},
                                       {"Shear damage reference length", "0 m"},
                                       {"Damage definition", "stiffness"},
                                       {"Damage strain", "total"},
                                       {"Damage weight", "none"},
                                       {"Tension limits", "mean stress"},
                                       {"Tensile rate law", "constant"},
                                       {"Fracture energy rate exponent", "1"},
                                       {"Crack band", "1"},
                                       {"Radial cracks", "0"},
                                       {"Crack model", "isotropic"},
                                       {"Opened volume kept", "0"},
                                       {"Crack dilatancy", "0"}};

/// Smallest slope of the crushing curve (Eq. 21) between C7 and C9, Pa: that of a parabola, at an end or at
/// its vertex.
double least_crushing_slope(const Hydrostat& h) {
  const double begin = h.form == HydrostatForm::shifted ? h.C7 : 0,
               vertex = begin - (h.K3 != 0 ? h.K2 / (3 * h.K3) : 0);
  return std::min(h.slope(std::nextafter(h.C7, h.C9)),
                  std::min(h.slope(h.C9), h.slope(std::clamp(vertex, std::nextafter(h.C7, h.C9), h.C9))));
}

} // namespace

void Afc::validate(const std::string& file, const std::string& section) const {
  const auto refuse = [&](const std::string& key, double found, Dimension dimension,
                          const std::string& allowed) {
    throw InputError(file + ": key '" + section + "/" + key + "': found '" +
                     format_quantity(found, dimension) + "', allowed: " + allowed);
  };
  if (!(hydrostat.C9 > hydrostat.C7)) refuse("C9", hydrostat.C9, Dimension::none, "> C7");
  if (const double slope = least_crushing_slope(hydrostat); !(slope >= 0))
    refuse("K1", hydrostat.K1, Dimension::stress,
           "K1, K2, K3 with which the pressure does not fall between C7 and C9 (its slope falls to " +
               in_six_digits(slope) + " Pa)");
  if (!(hydrostat.C8 >= bulk_modulus()))
    refuse("C8", hydrostat.C8, Dimension::stress,
           ">= C6 / C7 = " + format_quantity(bulk_modulus(), Dimension::stress));
  if (!(surface.C1 > surface.C2)) refuse("C1", surface.C1, Dimension::stress, "> C2");
  const auto with_directions = [&](const std::string& key, const std::string& found,
                                   const std::string& allowed) {
    throw InputError(file + ": key '" + section + "/" + key + "': found '" + found +
                     "', allowed: " + allowed + "; or any with Crack model = isotropic");
  };
  if (crack_model == CrackModel::isotropic) return;
  if (cracks.opening == Opening::cut_off) with_directions("Opening", "cut-off", "cracks");
  // Openings are strains: they and mu must add up.
  if (volumetric_strain == VolumetricStrain::density_ratio)
    with_directions("Volumetric strain", "density ratio", "logarithmic");
}

void Afc::declare(Parameters& parameters, Needed needed, const std::string& name_of_section) {
  auto section = parameters.section(name_of_section, std::move(needed));
  section.quantity("Density", density, Dimension::density, {above_zero}, "of the undeformed material");
  section.quantity("Shear modulus", G, Dimension::stress, {above_zero}, "G");
  section.choice(
      "Volumetric strain", volumetric_strain,
      {{"logarithmic", VolumetricStrain::logarithmic}, {"density ratio", VolumetricStrain::density_ratio}},
      "mu = -ln J, or density over initial density - 1");
  hydrostat.declare(section);
  surface.declare(section);
  shear.declare(section);
  tensile.declare(section);
  section.choice("Crack model", crack_model,
                 {{"isotropic", CrackModel::isotropic},
                  {"fixed", CrackModel::fixed},
                  {"rotating", CrackModel::rotating}},
                 "a crack takes stiffness and strength in all directions; or across itself alone, normal to "
                 "the principal stress that has opened it (fixed) or to the present one (rotating), instead "
                 "of Eq. 23: keys of tension that state strains and limits otherwise have no effect then");
  section.number("Crack friction", crack_friction, {0},
                 "of fixed cracks: shear stress over pressure at which faces that touch slip");
  cracks.declare(section);
  section.preset(
      "Readings", {{"ours", {}}, {"as printed", as_printed}},
      "how the equations of the paper are read: ours, the defaults of the keys of this section, or to the "
      "letter. A key that is set itself wins");
}

} // namespace spall
