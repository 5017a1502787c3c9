#include "macro/scene/scene_inputs.h"

#include "shared/error.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace spall {
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

  declare_cylinder(parameters, "Body", {});
  material.declare(parameters);

  const auto has_slab = [this] { return kind == SceneKind::slab; };
  projectile.declare(parameters, has_slab);
  witness.declare(parameters, has_slab);

  declare_rim(parameters, culvert, [this] { return kind == SceneKind::slab; });

  const auto modelled = [this] { return kind == SceneKind::taylor && anvil.deformable; };
  parameters.section("Anvil").choice(
      "Model", anvil.deformable, {{"rigid wall", false}, {"deformable", true}},
      "what a Taylor bar hits; the keys below are those of a deformable anvil, which stands on a rigid "
      "frictionless foundation");
  anvil.declare_cylinder(parameters, "Anvil", modelled);
  anvil.j2.declare(parameters, modelled, "Anvil");

  auto touch = parameters.section("Contact");
  touch.choice("Scheme", contact.scheme, contact_scheme_names,
               "between deformable bodies. surface: impulses between the points of the finer body and the "
               "surface of the other; kernel: forces where kernels overlap (paper, section 2.3)");
  touch.choice("Surface", contact.surface, contact_surface_names,
               "of a body that stays whole (projectile, plate), for the surface scheme. known: that of its "
               "shape, carried by its points; fitted: through its outermost points");
  touch.choice(
      "Normal", contact.normal, contact_normal_names,
      "of the kernel scheme. level set: gradient of the joint approximation (paper Eqs. 17-19); pair "
      "direction: between the points of a pair. The surface scheme uses the normal of the surface");
  touch.quantity("Start gap", start_gap, Dimension::length, {0, 1e3}, "distance of the bodies at the start");
  touch.number("Friction", contact.friction, {0, 10},
               "Coulomb coefficient between bodies, rigid or deformable");
  touch.number(
      "Stand-off", contact.stand_off, {0, 1},
      "distance from a rigid or known surface at which a point touches, in its spacings; constant in time");
  touch.number("Overlap release", contact.overlap_release, {0, 1},
               "part of an existing overlap that is taken back per step");
  touch.quantity("Release speed", contact.release_speed, Dimension::velocity, {0, 1e4},
                 "largest velocity at which it is taken back: points pushed out keep it");
}

void SceneInputs::validate(const std::string& file) const {
  if (kind == SceneKind::slab) projectile.validate(file, planes(), flight());
  validate_cylinder(file, "Body");
  if (anvil.deformable) anvil.validate_cylinder(file, "Anvil");
  if (culvert.present && kind != SceneKind::slab)
    throw InputError(file + ": key 'Rim/Model': only a slab has a culvert");
  for (const char* alone : {"none", "axis"})
    if (symmetry.size() > 1 && std::find(symmetry.begin(), symmetry.end(), alone) != symmetry.end())
      throw InputError(file + ": key 'Scene/Symmetry planes': '" + alone + "' stands alone");
  if (planes().axis && filling.layout == Layout::lattice)
    throw InputError(
        file + ": key 'Body/Layout': a lattice has no rotational symmetry; Scene/Symmetry planes = axis "
               "wants polar");
  material.validate(file);
}

SymmetryPlanes SceneInputs::planes() const {
  const auto has = [this](const char* axis) {
    return std::find(symmetry.begin(), symmetry.end(), axis) != symmetry.end();
  };
  return {.normal = {has("x"), has("y"), false}, .axis = has("axis")};
}

Points make_points(const SceneInputs& inputs) {
  Points points = fill_cylinder(inputs.cylinder(0), inputs.filling, inputs.planes(), inputs.material.density());
  if (inputs.kind == SceneKind::taylor)
    for (std::size_t i = 0; i < points.owned; ++i) points.velocity.set(i, {0, 0, -inputs.impact_velocity});
  return points;
}

Points make_anvil_points(const SceneInputs& inputs) {
  const AnvilInputs& a = inputs.anvil;
  return fill_cylinder(a.cylinder(-inputs.start_gap - a.height), a.filling, inputs.planes(), a.j2.density);
}

Culvert make_culvert(const SceneInputs& inputs, const Points& points, const Ranks& ranks) {
  const double area = std::numbers::pi * inputs.diameter * inputs.height / inputs.planes().multiplicity();
  return {inputs.culvert, points, 0.5 * inputs.diameter, area, ranks};
}

RigidBody make_rigid_body(const SceneInputs& inputs) {
  const double under = inputs.anvil.deformable ? inputs.anvil.height : 0;
  if (inputs.kind == SceneKind::taylor)
    return {
        .shape = PlaneWall{}, .position = {0, 0, -inputs.start_gap - under}, .free = {false, false, false}};
  if (inputs.projectile.is_deformable()) return {.shape = Nothing{}, .free = {}};
  return inputs.projectile.rigid_body(inputs.planes(), inputs.flight());
}

} // namespace spall
