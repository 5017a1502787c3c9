#include "macro/scene/cylinder_inputs.h"

#include "shared/error.h"

namespace spall {

void CylinderInputs::declare_cylinder(Parameters& parameters, const std::string& name,
                                      const std::function<bool()>& needed) {
  auto section = parameters.section(name, needed);
  section.quantity("Diameter", diameter, Dimension::length, {above_zero, 1e3}, "of the slab, bar or anvil");
  section.quantity("Height", height, Dimension::length, {above_zero, 1e3},
                   "thickness of the slab or anvil, length of the bar");
  section.quantity("Hole diameter", hole_diameter, Dimension::length, {0, 1e3},
                   "of a hole along the axis: a pilot hole; 0: none; rings are counted from its wall");
  section.choice(
      "Layout", filling.layout, {{"polar", Layout::polar}, {"lattice", Layout::lattice}},
      "of the points. polar: concentric rings in layers; lattice: Cartesian, with a staircase for a rim");
  section.integer("Layers", filling.layers, {0, 100000},
                  "points over the height; 0 only if the spacing is graded");
  section.integer("Rings", filling.rings, {0, 100000},
                  "points over the radius: concentric rings; 0 only if the spacing is graded");
  section.choice(
      "Boundary points", filling.boundary,
      {{"centred", Boundary::centred}, {"on surface", Boundary::on_surface}},
      "outermost points half a spacing inside, or on the surface with part of a cell (of a lattice on the "
      "end faces only)");
  Grading& grading = filling.grading;
  parameters.section(name, [] { return false; })
      .quantity("Fine spacing", grading.fine_spacing, Dimension::length, {above_zero, 1e3},
                "of the points near the axis, if the spacing is graded (instead of Rings and Layers; polar "
                "only); the keys below go with it");
  auto graded =
      parameters.section(name, [this, needed] { return filling.grading.used() && (!needed || needed()); });
  graded.quantity("Fine radius", grading.fine_radius, Dimension::length, {0, 1e3},
                  "as far as which the fine spacing goes");
  graded.number("Growth", grading.growth, {1, 2}, "widest of two neighbouring rings over the other");
  graded.quantity("Coarse spacing", grading.coarse_spacing, Dimension::length, {above_zero, 1e3},
                  "largest spacing, at the rim");
  section.number("Jitter", filling.jitter.amount, {0, 0.95},
                 "random displacement of the points, as part of the way to the wall of their cell");
  section.integer("Jitter seed", filling.jitter.seed, {0, 1000000}, "of the random displacement");
}

void CylinderInputs::validate_cylinder(const std::string& file, const std::string& section) const {
  const auto refuse = [&](const std::string& key, const std::string& why) {
    throw InputError(file + ": key '" + section + "/" + key + "': " + why);
  };
  const auto text = [](double length) { return format_quantity(length, Dimension::length); };
  const Grading& grading = filling.grading;
  if (!(hole_diameter < diameter))
    refuse("Hole diameter",
           "found " + text(hole_diameter) + ", allowed: less than Diameter, " + text(diameter));
  if (hole_diameter > 0 && filling.layout == Layout::lattice)
    refuse("Hole diameter", "found " + text(hole_diameter) + ", allowed: 0 with Layout = lattice");
  if (grading.used()) {
    if (filling.layout == Layout::lattice)
      refuse("Layout",
             "a lattice has one spacing; Fine spacing (" + text(grading.fine_spacing) + ") wants polar");
    if (filling.rings > 0 || filling.layers > 0)
      refuse("Fine spacing", "the spacing is either graded, " + text(grading.fine_spacing) +
                                 " at the axis, or given by Rings and Layers (" +
                                 std::to_string(filling.rings) + ", " + std::to_string(filling.layers) +
                                 "): set these to 0, or leave it out");
    if (grading.coarse_spacing < grading.fine_spacing)
      refuse("Coarse spacing", "found " + text(grading.coarse_spacing) +
                                   ", allowed: at least Fine spacing, " + text(grading.fine_spacing));
    if (grading.coarse_spacing > height / 2)
      refuse("Coarse spacing", "found " + text(grading.coarse_spacing) +
                                   ", allowed: at most half of Height, " + text(height / 2) +
                                   " (a single layer cannot bend)");
    return;
  }
  const int fewest = filling.boundary == Boundary::on_surface ? 2 : 1;
  if (filling.layers < fewest)
    refuse("Layers",
           "found " + std::to_string(filling.layers) + ", allowed: at least " + std::to_string(fewest) +
               (fewest > 1 ? " (points on both faces)" : ", or a Fine spacing instead of Rings and Layers"));
  if (filling.rings < 1)
    refuse("Rings", "found 0, allowed: at least 1, or a Fine spacing instead of Rings and Layers");
}

} // namespace spall
