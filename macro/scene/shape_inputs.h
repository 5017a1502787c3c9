#pragma once

#include "macro/shape/fill.h"
#include "macro/shape/projectile.h"
#include "shared/input/parameters.h"

#include <functional>
#include <string>

namespace spall {

/// What can be the shape of a body. `unset`: the file must say which.
enum class ShapeKind { unset, cylinder, block, projectile, sphere, profile, half_space };

/// The shape of a body, as keys of the body's section of a scene file. A key is asked for only by the shapes
/// that have it.
struct ShapeInputs {
  ShapeKind kind = ShapeKind::unset;
  double diameter = required;                ///< cylinder, projectile, sphere, m
  double height = required;                  ///< cylinder, block: along z, m
  double hole_diameter = 0;                  ///< cylinder, m
  double width = required, depth = required; ///< block: along x and y, m
  double length = required;                  ///< projectile: tip to tail, m
  Nose nose;                                 ///< projectile
  double nose_thickness = required, base_thickness = required,
         wall_thickness = required; ///< projectile: walls of a hollow one, m; NaN: not set
  std::string profile;              ///< file with the contour

  /// `needed`: whether the body is in the scene, so that its keys without default must be set.
  void declare(Parameters& parameters, const std::string& section, const std::function<bool()>& needed);
  /// What no single key can check. Call complete_wall before, for a body whose mass and density are known.
  /// @throws InputError: one line with the file, the key, what was found and what is allowed. `file` names
  /// the input in messages.
  void validate(const std::string& file, const std::string& section) const;

  bool is_hollow() const; ///< whether any wall thickness is set
  /// For a hollow projectile without a wall thickness: sets the one that gives the casing this mass.
  /// @param mass kg, @param density of the casing, kg/m^3; NaN: not known
  void complete_wall(double mass, double density);
  /// Of valid inputs. Projectile, sphere and profile have their tip at z = 0 and fly along +z; cylinder and
  /// block stand on z = 0.
  Shape shape() const;

private:
  Projectile projectile() const { return {.diameter = diameter, .length = length, .nose = nose}; }
  /// Thicknesses that are not set are those of the side wall.
  CasingWalls walls() const;
};

/// The points that fill a body, as keys of its section of a scene file.
struct FillingInputs {
  Filling filling;

  void declare(Parameters& parameters, const std::string& section, const std::function<bool()>& needed);
  /// @throws InputError as above
  void validate(const std::string& file, const std::string& section, const Shape& shape) const;

private:
  void validate_grading(const std::string& file, const std::string& section, const Cylinder& shape) const;
  void validate_cylinder(const std::string& file, const std::string& section, const Cylinder& shape) const;
  void validate_revolution(const std::string& file, const std::string& section, bool hollow) const;
  void validate_block(const std::string& file, const std::string& section) const;
};

} // namespace spall
