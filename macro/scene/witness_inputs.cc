#include "macro/scene/witness_inputs.h"

namespace spall {

void WitnessInputs::declare(Parameters& parameters, const std::function<bool()>& in_scene) {
  parameters.section("Witness").choice("Model", present, {{"none", false}, {"plate", true}},
                                       "what stands behind the slab; the keys below are those of the plate, "
                                       "which is free and of J2 metal");
  const auto needed = [this, in_scene] { return present && in_scene(); };
  auto section = parameters.section("Witness", needed);
  section.quantity("Diameter", diameter, Dimension::length, {above_zero, 1e3}, "of the plate");
  section.quantity("Thickness", thickness, Dimension::length, {above_zero, 1e3}, "of the plate");
  section.quantity("Distance", distance, Dimension::length, {0, 1e3},
                   "from the slab's back to the plate's front; less than the projectile's length and it hits "
                   "the plate before it has left the slab");
  section.integer("Rings", rings, {1, 100000}, "concentric rings of points over the radius");
  section.integer("Layers", layers, {1, 100000}, "points through the plate");
  section.flag("Stop when passed", stop_when_passed,
               "end the run when the projectile's tail is behind the plate, else only at Time/End time");
  j2.declare(parameters, needed, "Witness");
}

Cylinder WitnessInputs::cylinder(double slab) const {
  return {.radius = 0.5 * diameter, .height = thickness, .bottom = slab + distance};
}

Points WitnessInputs::fill(double slab, const SymmetryPlanes& planes) const {
  return fill_cylinder(cylinder(slab), {.rings = rings, .layers = layers}, planes, j2.density);
}

KnownSurface WitnessInputs::surface(double slab, const Points& points) const {
  const Cylinder c = cylinder(slab);
  return known_surface(Cylinder{.radius = c.radius, .height = c.height}, identity3, {0, 0, c.bottom}, points);
}

} // namespace spall
