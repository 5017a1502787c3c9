#pragma once

#include "macro/contact/carried_surface.h"
#include "macro/material/j2.h"
#include "macro/points/ghosts.h"
#include "macro/shape/projectile.h"
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

enum class ProjectileModel { rigid, deformable };

/// The `Projectile` section of a scene file.
struct ProjectileInputs {
  double diameter = required, length = required, caliber_radius_head = required, mass = required;
  /// From the tip, m; about axes through it, kg m^2. NaN: of a homogeneous body of this shape and mass.
  double centre_of_mass = required, axial_moment = required, transverse_moment = required;

  ProjectileModel model = ProjectileModel::rigid;
  // Deformable: an empty casing, whose density stands for the filler's mass too. The wall is as thick as mass
  // and density make it.
  double nose_thickness = required, base_thickness = required; ///< from the cavity to tip and tail, m
  int rings = 2, layers = 76;                                  ///< points through the wall, over the length
  J2 j2;

  /// `needed`: whether the scene has a projectile.
  void declare(Parameters& parameters, const std::function<bool()>& needed);
  void validate(const std::string& file, const SymmetryPlanes& planes, const Flight& flight) const;

  Projectile projectile() const;
  /// The part of it between the symmetry planes, with the motions that keep the planes.
  RigidBody rigid_body(const SymmetryPlanes& planes, const Flight& flight) const;
  /// The points of a deformable one, where and as fast as the rigid one.
  Points fill(const SymmetryPlanes& planes, const Flight& flight) const;
  KnownSurface surface(const SymmetryPlanes& planes, const Flight& flight, const Points& points) const;

  double wall_thickness() const; ///< of the casing, m; not positive if nose and base are too heavy
  bool is_deformable() const { return model == ProjectileModel::deformable; }
};

} // namespace spall
