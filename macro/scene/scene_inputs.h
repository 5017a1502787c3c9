#pragma once

#include "macro/contact/rigid_contact.h"
#include "macro/material/afc.h"
#include "macro/material/j2.h"
#include "macro/material/material_input.h"
#include "macro/points/ghosts.h"
#include "macro/scene/fill.h"
#include "shared/input/parameters.h"

#include <string>
#include <vector>

namespace spall {

/// What is shot at what.
enum class SceneKind {
  slab,  ///< rigid ogive projectile through a circular slab
  taylor ///< cylinder against a rigid wall
};

/// The physical part of a scene file.
struct SceneInputs {
  SceneKind kind = SceneKind::slab;
  std::vector<std::string> symmetry; ///< "x", "y": planes through the axis

  // The deformable cylinder: slab or bar.
  double diameter = required, height = required; ///< m
  int rings = 10, layers = 8;
  Boundary boundary = Boundary::centred;
  Jitter jitter;

  Law law = Law::AFC;
  Afc afc;
  J2 j2;

  double impact_velocity = required; ///< of the projectile (slab) or the bar (Taylor), m/s
  // The projectile (slab only).
  double projectile_diameter = required, projectile_length = required, caliber_radius_head = required,
         projectile_mass = required;
  ContactInputs contact;

  /// Binds everything above. Lives as long as `parameters` is used.
  void declare(Parameters& parameters);
  /// Checks that go beyond one key. @throws InputError. `file` names the input in messages.
  void validate(const std::string& file) const;

  SymmetryPlanes planes() const;
  double density() const { return law == Law::AFC ? afc.density : j2.density; }
};

/// The points of the deformable body, with their initial velocity.
Points make_points(const SceneInputs& inputs);
/// The rigid body it meets: the projectile (mass of the modelled part) or the wall.
RigidBody make_rigid_body(const SceneInputs& inputs);

} // namespace spall
