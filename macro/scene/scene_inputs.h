#pragma once

#include "macro/contact/rigid_contact.h"
#include "macro/material/material_inputs.h"
#include "macro/points/ghosts.h"
#include "macro/scene/cylinder_inputs.h"
#include "macro/scene/projectile_inputs.h"
#include "macro/scene/rim_inputs.h"
#include "macro/scene/witness_inputs.h"
#include "shared/input/parameters.h"

#include <string>
#include <vector>

namespace spall {

/// What is shot at what.
enum class SceneKind {
  slab,  ///< rigid ogive projectile through a circular slab
  taylor ///< cylinder against a rigid wall
};

/// A deformable anvil for a Taylor bar: a cylinder with the bar's axis, on a rigid foundation.
struct AnvilInputs : CylinderInputs {
  AnvilInputs() { filling = {.rings = 16, .layers = 16, .boundary = Boundary::on_surface}; }

  bool deformable = false; ///< false: a rigid wall in its place
  J2 j2;
};

/// The physical part of a scene file. The cylinder is the slab or the bar.
struct SceneInputs : CylinderInputs {
  SceneKind kind = SceneKind::slab;
  std::vector<std::string> symmetry; ///< "x", "y": planes through the axis; "none"

  MaterialInputs material; ///< of the body

  double impact_velocity = required; ///< of the projectile (slab) or the bar (Taylor), m/s
  double obliquity = 0, attack = 0;  ///< of the impact and of the projectile's axis, rad
  ProjectileInputs projectile;       ///< slab only
  CulvertInputs culvert;             ///< slab only
  WitnessInputs witness;             ///< slab only
  AnvilInputs anvil;                 ///< Taylor only
  ContactInputs contact;
  double start_gap = 0; ///< between the bodies, m

  /// Binds everything above. Lives as long as `parameters` is used.
  void declare(Parameters& parameters);
  /// Checks that go beyond one key. @throws InputError. `file` names the input in messages.
  void validate(const std::string& file) const;

  SymmetryPlanes planes() const;
  Flight flight() const { return {impact_velocity, obliquity, attack, start_gap}; }
};

/// The points of the deformable body, with their initial velocity.
Points make_points(const SceneInputs& inputs);
/// The points of the deformable anvil: its upper face is the start gap below z = 0.
Points make_anvil_points(const SceneInputs& inputs);
/// The ring around the slab that these points are.
Culvert make_culvert(const SceneInputs& inputs, const Points& points, const Ranks& ranks);
/// The rigid body of the scene: the projectile (mass of the modelled part), the wall, or the foundation of
/// the anvil.
RigidBody make_rigid_body(const SceneInputs& inputs);

} // namespace spall
