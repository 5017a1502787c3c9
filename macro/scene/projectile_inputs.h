#pragma once

#include "macro/contact/rigid_body.h"
#include "macro/points/ghosts.h"
#include "shared/input/parameters.h"

#include <string>

namespace spall {

/// How the projectile meets the slab: in the x-z plane, angles in rad.
struct Flight {
  double speed = 0;     ///< m/s
  double obliquity = 0; ///< of the flight from the slab's normal, towards +x
  double attack = 0;    ///< of the projectile's axis from the flight, towards +x
  double start_gap = 0; ///< from the foremost point of the projectile to the slab, m

  bool is_normal() const { return obliquity == 0 && attack == 0; }
};

/// The `Projectile` section of a scene file.
struct ProjectileInputs {
  double diameter = required, length = required, caliber_radius_head = required, mass = required;
  /// From the tip, m; about axes through it, kg m^2. NaN: of a homogeneous body of this shape and mass.
  double centre_of_mass = required, axial_moment = required, transverse_moment = required;

  /// `needed`: whether the scene has a projectile.
  void declare(Parameters& parameters, const std::function<bool()>& needed);
  void validate(const std::string& file, const SymmetryPlanes& planes, const Flight& flight) const;

  Ogive ogive() const;
  /// The part of it between the symmetry planes, with the motions that keep the planes.
  RigidBody rigid_body(const SymmetryPlanes& planes, const Flight& flight) const;
};

} // namespace spall
