#include "macro/scene/scene_inputs.h"

#include "shared/error.h"

#include <algorithm>
#include <cmath>

namespace spall {

void SceneInputs::declare(Parameters& parameters) {
  auto scene = parameters.section("Scene");
  scene.choice("Kind", kind, {{"slab", SceneKind::slab}, {"taylor", SceneKind::taylor}},
               "slab: rigid ogive projectile through a circular slab; taylor: bar against a rigid wall");
  scene.words("Symmetry planes", symmetry, {"x", "y"},
              "planes through the axis of which only the positive side is modelled: none, x, y or x, y");
  scene.quantity("Impact velocity", impact_velocity, Dimension::velocity, {0, 1e4},
                 "of the projectile (slab) or of the bar (taylor)");

  auto body = parameters.section("Body");
  body.quantity("Diameter", diameter, Dimension::length, {above_zero, 1e3}, "of the slab or the bar");
  body.quantity("Height", height, Dimension::length, {above_zero, 1e3},
                "thickness of the slab, length of the bar");
  body.integer("Layers", layers, {1, 100000}, "points over the height");
  body.integer("Rings", rings, {1, 100000}, "concentric rings of points over the radius");
  body.choice("Boundary points", boundary,
              {{"centred", Boundary::centred}, {"on surface", Boundary::on_surface}},
              "outermost points half a spacing inside, or on the surface with part of a cell");
  body.number("Jitter", jitter.amount, {0, 0.95},
              "random displacement of the points, as part of the way to the wall of their cell");
  body.integer("Jitter seed", jitter.seed, {0, 1000000}, "of the random displacement");

  declare_law(parameters, law);
  afc.declare(parameters, [this] { return law == Law::AFC; });
  j2.declare(parameters, [this] { return law == Law::J2; });

  auto projectile = parameters.section("Projectile", [this] { return kind == SceneKind::slab; });
  projectile.quantity("Diameter", projectile_diameter, Dimension::length, {above_zero, 1e3}, "of the body");
  projectile.quantity("Length", projectile_length, Dimension::length, {above_zero, 1e3}, "tip to tail");
  projectile.number("Caliber radius head", caliber_radius_head, {0.5, 100},
                    "radius of the ogive's arc in diameters; 0.5 is a hemisphere");
  projectile.quantity("Mass", projectile_mass, Dimension::mass, {above_zero, 1e9}, "of the whole projectile");

  auto touch = parameters.section("Contact");
  touch.number("Friction", contact.friction, {0, 10},
               "Coulomb coefficient between the body and the rigid surface");
  touch.number("Stand-off", contact.stand_off, {0, 1},
               "distance from the rigid surface at which a point touches, in its spacings; constant in time");
  touch.number("Overlap release", contact.overlap_release, {0, 1},
               "part of an existing overlap that is taken back per step");
}

void SceneInputs::validate(const std::string& file) const {
  if (kind == SceneKind::slab && projectile_length < Ogive{0.5 * projectile_diameter, projectile_length,
                                                           caliber_radius_head * projectile_diameter}
                                                         .nose_length())
    throw InputError(file +
                     ": key 'Projectile/Length': shorter than the nose that Diameter and Caliber radius head "
                     "make");
  if (boundary == Boundary::on_surface && layers < 2)
    throw InputError(file + ": key 'Body/Layers': points on both faces need at least 2");
  if (law == Law::AFC) afc.validate(file);
}

SymmetryPlanes SceneInputs::planes() const {
  const auto has = [this](const char* axis) {
    return std::find(symmetry.begin(), symmetry.end(), axis) != symmetry.end();
  };
  return {{has("x"), has("y"), false}};
}

Points make_points(const SceneInputs& inputs) {
  Points points =
      fill_cylinder({.radius = 0.5 * inputs.diameter, .height = inputs.height, .bottom = 0}, inputs.rings,
                    inputs.layers, inputs.boundary, inputs.planes(), inputs.density(), inputs.jitter);
  if (inputs.kind == SceneKind::taylor)
    for (std::size_t i = 0; i < points.owned; ++i) points.velocity.set(i, {0, 0, -inputs.impact_velocity});
  return points;
}

RigidBody make_rigid_body(const SceneInputs& inputs) {
  if (inputs.kind == SceneKind::taylor) return {.shape = PlaneWall{}, .free = {false, false, false}};
  RigidBody body;
  body.shape = Ogive{.radius = 0.5 * inputs.projectile_diameter,
                     .length = inputs.projectile_length,
                     .ogive_radius = inputs.caliber_radius_head * inputs.projectile_diameter};
  body.mass = inputs.projectile_mass / inputs.planes().multiplicity();
  body.velocity = {0, 0, inputs.impact_velocity};
  return body;
}

} // namespace spall
