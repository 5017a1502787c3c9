#pragma once

#include "macro/shape/revolution.h"

#include <string>

namespace spall {

/// Noses of projectiles, all followed by a cylindrical shaft.
enum class NoseKind {
  ogive,           ///< arc tangent to the shaft, pointed
  hemisphere,      ///< half a sphere
  cone,            ///< straight to the tip
  truncated_ogive, ///< a tangent ogive cut off square where it is as wide as the tip diameter
  flat,            ///< none: a cylinder
  blunt            ///< flat with a rounded edge
};

/// A nose. Only the numbers of its kind are used.
struct Nose {
  NoseKind kind = NoseKind::ogive;
  double caliber_radius_head = std::numeric_limits<double>::quiet_NaN(); ///< (truncated) ogive: arc radius
                                                                         ///< in diameters, at least 0.5
  double length = std::numeric_limits<double>::quiet_NaN();              ///< cone, m
  double tip_diameter = std::numeric_limits<double>::quiet_NaN();        ///< truncated ogive, m
  double edge_radius = std::numeric_limits<double>::quiet_NaN();         ///< blunt, m
};

/// A projectile with a nose and a cylindrical shaft: axis along z, tip at z = 0, tail at z = -length; it
/// flies along +z.
struct Projectile {
  double diameter = 0, length = 0; ///< m
  Nose nose;

  /// From the tip to the shaft, m.
  double nose_length() const;
  /// @throws std::invalid_argument if there is no such body
  Contour contour() const;
};

/// A (truncated) tangent ogive with a shaft, by its lengths, m. The arc's centre lies at r = radius -
/// arc_radius and at the z of the shoulder.
struct TangentOgive {
  double radius = 0, length = 0, arc_radius = 0;
  double tip_radius = 0; ///< of the flat tip

  double nose_length() const;
  Contour contour() const;
};

/// The whole sphere, from z = 0 to z = -diameter. @param diameter m
Contour sphere_contour(double diameter);

/// The walls of a hollow projectile (an empty casing), m.
struct CasingWalls {
  double nose = 0; ///< from the tip to the cavity
  double base = 0; ///< from the cavity to the tail
  double side = 0; ///< of the shaft
};

/// The casing. The cavity's nose ends where the outer nose does: a cone in a cone, else an arc tangent to the
/// inner side of the wall; it is flat if the nose wall is thicker than the nose is long.
/// @throws std::invalid_argument if there is no cavity, or if it breaks through the nose
Revolution casing(const Projectile& projectile, const CasingWalls& walls);

/// The side wall that gives the casing this much metal, m; 0 if no wall does. `walls.side` is not used.
/// @param volume of the metal, m^3
double side_wall(const Projectile& projectile, const CasingWalls& walls, double volume);

} // namespace spall
