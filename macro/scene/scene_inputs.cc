#include "macro/scene/scene_inputs.h"

#include "shared/error.h"

#include <algorithm>
#include <cmath>

namespace spall {
namespace {

void declare_cylinder(Parameters::Section section, double& diameter, double& height, int& rings, int& layers,
                      Boundary& boundary) {
  section.quantity("Diameter", diameter, Dimension::length, {above_zero, 1e3}, "of the slab, bar or anvil");
  section.quantity("Height", height, Dimension::length, {above_zero, 1e3},
                   "thickness of the slab or anvil, length of the bar");
  section.integer("Layers", layers, {1, 100000}, "points over the height");
  section.integer("Rings", rings, {1, 100000}, "concentric rings of points over the radius");
  section.choice("Boundary points", boundary,
                 {{"centred", Boundary::centred}, {"on surface", Boundary::on_surface}},
                 "outermost points half a spacing inside, or on the surface with part of a cell");
}

} // namespace

void SceneInputs::declare(Parameters& parameters) {
  auto scene = parameters.section("Scene");
  scene.choice(
      "Kind", kind, {{"slab", SceneKind::slab}, {"taylor", SceneKind::taylor}},
      "slab: rigid ogive projectile through a circular slab; taylor: bar against a wall or an anvil");
  scene.words(
      "Symmetry planes", symmetry, {"none", "x", "y", "axis"},
      "planes through the axis of which only the positive side is modelled: none, x, y or x, y; axis: "
      "rotational symmetry, one half plane of points that stand for rings");
  scene.quantity("Impact velocity", impact_velocity, Dimension::velocity, {0, 1e4},
                 "of the projectile (slab) or of the bar (taylor)");
  scene.quantity("Obliquity", obliquity, Dimension::angle, {-1.5, 1.5},
                 "angle in the x-z plane between the projectile's flight and the slab's normal");
  scene.quantity("Angle of attack", attack, Dimension::angle, {-1.5, 1.5},
                 "angle in the x-z plane between the projectile's axis and its flight");

  auto body = parameters.section("Body");
  declare_cylinder(body, diameter, height, rings, layers, boundary);
  body.number("Jitter", jitter.amount, {0, 0.95},
              "random displacement of the points, as part of the way to the wall of their cell");
  body.integer("Jitter seed", jitter.seed, {0, 1000000}, "of the random displacement");
  declare_law(parameters, law);
  afc.declare(parameters, [this] { return law == Law::AFC; });
  j2.declare(parameters, [this] { return law == Law::J2; });

  projectile.declare(parameters, [this] { return kind == SceneKind::slab; });

  const auto modelled = [this] { return kind == SceneKind::taylor && anvil.deformable; };
  parameters.section("Anvil").choice(
      "Model", anvil.deformable, {{"rigid wall", false}, {"deformable", true}},
      "what a Taylor bar hits; the keys below are those of a deformable anvil, which stands on a rigid "
      "frictionless foundation");
  declare_cylinder(parameters.section("Anvil", modelled), anvil.diameter, anvil.height, anvil.rings,
                   anvil.layers, anvil.boundary);
  anvil.j2.declare(parameters, modelled, "Anvil");

  auto touch = parameters.section("Contact");
  touch.choice("Scheme", contact.scheme, contact_scheme_names,
               "between deformable bodies. surface: impulses between the points of the finer body and the "
               "surface of the other; kernel: forces where kernels overlap (paper, section 2.3)");
  touch.choice(
      "Normal", contact.normal, contact_normal_names,
      "of the kernel scheme. level set: gradient of the joint approximation (paper Eqs. 17-19); pair "
      "direction: between the points of a pair. The surface scheme uses the normal of the surface");
  touch.quantity("Start gap", start_gap, Dimension::length, {0, 1e3}, "distance of the bodies at the start");
  touch.number("Friction", contact.friction, {0, 10},
               "Coulomb coefficient between bodies, rigid or deformable");
  touch.number("Stand-off", contact.stand_off, {0, 1},
               "distance from the rigid surface at which a point touches, in its spacings; constant in time");
  touch.number("Overlap release", contact.overlap_release, {0, 1},
               "part of an existing overlap that is taken back per step");
}

void SceneInputs::validate(const std::string& file) const {
  if (kind == SceneKind::slab) projectile.validate(file, planes(), flight());
  if (boundary == Boundary::on_surface && layers < 2)
    throw InputError(file + ": key 'Body/Layers': points on both faces need at least 2");
  if (anvil.deformable && anvil.boundary == Boundary::on_surface && anvil.layers < 2)
    throw InputError(file + ": key 'Anvil/Layers': points on both faces need at least 2");
  for (const char* alone : {"none", "axis"})
    if (symmetry.size() > 1 && std::find(symmetry.begin(), symmetry.end(), alone) != symmetry.end())
      throw InputError(file + ": key 'Scene/Symmetry planes': '" + alone + "' stands alone");
  if (law == Law::AFC) afc.validate(file);
}

SymmetryPlanes SceneInputs::planes() const {
  const auto has = [this](const char* axis) {
    return std::find(symmetry.begin(), symmetry.end(), axis) != symmetry.end();
  };
  return {.normal = {has("x"), has("y"), false}, .axis = has("axis")};
}

Points make_points(const SceneInputs& inputs) {
  Points points =
      fill_cylinder({.radius = 0.5 * inputs.diameter, .height = inputs.height, .bottom = 0}, inputs.rings,
                    inputs.layers, inputs.boundary, inputs.planes(), inputs.density(), inputs.jitter);
  if (inputs.kind == SceneKind::taylor)
    for (std::size_t i = 0; i < points.owned; ++i) points.velocity.set(i, {0, 0, -inputs.impact_velocity});
  return points;
}

Points make_anvil_points(const SceneInputs& inputs) {
  const AnvilInputs& a = inputs.anvil;
  return fill_cylinder(
      {.radius = 0.5 * a.diameter, .height = a.height, .bottom = -inputs.start_gap - a.height}, a.rings,
      a.layers, a.boundary, inputs.planes(), a.j2.density);
}

RigidBody make_rigid_body(const SceneInputs& inputs) {
  const double under = inputs.anvil.deformable ? inputs.anvil.height : 0;
  if (inputs.kind == SceneKind::taylor)
    return {
        .shape = PlaneWall{}, .position = {0, 0, -inputs.start_gap - under}, .free = {false, false, false}};
  return inputs.projectile.rigid_body(inputs.planes(), inputs.flight());
}

} // namespace spall
