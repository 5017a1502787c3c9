#pragma once

#include "macro/shape/contour_table.h"
#include "macro/shape/projectile.h"
#include "macro/shape/shape.h"
#include "shared/error.h"
#include "shared/input/parameters.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace spall {

// The kinds of shapes that a scene file can ask for. This is one file, with functions in it, so that all that
// a kind of shape is made of (its word, its keys, what no single key can check, and the shape) stands in one
// place.

/// What can be the shape of a body. `unset`: the file must say which.
enum class ShapeKind { unset, cylinder, block, projectile, sphere, profile, surface, half_space };

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
  std::string surface_file;         ///< file with the triangles of a surface
  double surface_unit = 0;          ///< length that its number 1 stands for, m; 0: not set

  /// `needed`: whether the body is in the scene, so that its keys without default must be set.
  void declare(Parameters& parameters, const std::string& section, const Needed& needed);
  /// What no single key can check. Call complete_wall before, for a body whose mass and density are known.
  /// @throws InputError: one line with the file, the key, what was found and what is allowed. `file` names
  /// the input in messages.
  void validate(const std::string& file, const std::string& section) const;

  bool is_hollow() const; ///< whether any wall thickness is set
  /// For a hollow projectile without a wall thickness: sets the one that gives the casing this mass.
  /// @param mass kg, @param density of the casing, kg/m^3; NaN: not known
  void complete_wall(double mass, double density);
  /// Of valid inputs. Projectile, sphere and profile have their tip at z = 0 and fly along +z; cylinder and
  /// block stand on z = 0; a surface lies as in its file.
  Shape shape() const;

private:
  void
  validate_projectile(const std::function<void(const std::string& key, const std::string& why)>& wrong) const;
  Projectile projectile() const { return {.diameter = diameter, .length = length, .nose = nose}; }
  /// Thicknesses that are not set are those of the side wall.
  CasingWalls walls() const;
};

namespace shape_keys {
inline const Choices<ShapeKind> kinds = {
    {"none", ShapeKind::unset},      {"cylinder", ShapeKind::cylinder},
    {"block", ShapeKind::block},     {"projectile", ShapeKind::projectile},
    {"sphere", ShapeKind::sphere},   {"profile", ShapeKind::profile},
    {"surface", ShapeKind::surface}, {"half space", ShapeKind::half_space}};
inline const Choices<double> surface_units = {
    {"none", 0}, {"m", 1}, {"cm", 1e-2}, {"mm", 1e-3}, {"in", 25.4e-3}};
inline const Choices<NoseKind> noses = {
    {"ogive", NoseKind::ogive}, {"hemisphere", NoseKind::hemisphere},
    {"cone", NoseKind::cone},   {"truncated ogive", NoseKind::truncated_ogive},
    {"flat", NoseKind::flat},   {"blunt", NoseKind::blunt}};
constexpr Range any_length = {above_zero, 1e3};
inline std::string format_length(double length) { return format_quantity(length, Dimension::length); }
} // namespace shape_keys

inline void ShapeInputs::declare(Parameters& parameters, const std::string& name, const Needed& needed) {
  parameters.section(name).choice(
      "Shape", kind, shape_keys::kinds,
      "of the body; must be set. cylinder: slab, bar, plate, on z = 0 with its axis along z; block: cuboid, "
      "on z = 0; projectile: nose and cylindrical shaft, which flies along +z; sphere; profile: body of "
      "revolution about z whose contour a file gives; surface: closed surface of triangles from an STL file, "
      "as it lies there; half space: everything below z = 0, rigid");
  const auto of = [&](const std::vector<ShapeKind>& those) {
    return parameters.section(name, needed_if("Shape", kind, shape_keys::kinds, those) && needed);
  };
  const auto of_nose = [&](const std::vector<NoseKind>& those) {
    return parameters.section(name, needed_if("Shape", kind, shape_keys::kinds, {ShapeKind::projectile}) &&
                                        needed_if("Nose", nose.kind, shape_keys::noses, those) && needed);
  };
  auto optional = parameters.section(name, Needed::never());
  of({ShapeKind::cylinder, ShapeKind::projectile, ShapeKind::sphere})
      .quantity("Diameter", diameter, Dimension::length, shape_keys::any_length,
                "of a cylinder, of a projectile's shaft, of a sphere");
  of({ShapeKind::cylinder, ShapeKind::block})
      .quantity("Height", height, Dimension::length, shape_keys::any_length,
                "of a cylinder or block, along z: the thickness of a slab or plate, the length of a bar");
  optional.quantity("Hole diameter", hole_diameter, Dimension::length, {0, 1e3},
                    "of a hole along the axis of a cylinder (a pilot hole); 0: none. Rings are counted from "
                    "its wall");
  auto block = of({ShapeKind::block});
  block.quantity("Width", width, Dimension::length, shape_keys::any_length, "of a block, along x");
  block.quantity("Depth", depth, Dimension::length, shape_keys::any_length, "of a block, along y");
  of({ShapeKind::projectile})
      .quantity("Length", length, Dimension::length, shape_keys::any_length,
                "of a projectile, from tip to tail");
  parameters.section(name).choice("Nose", nose.kind, shape_keys::noses,
                                  "of a projectile. ogive: pointed, its arc tangent to the shaft; truncated "
                                  "ogive: with a flat tip; blunt: "
                                  "flat with a rounded edge");
  of_nose({NoseKind::ogive, NoseKind::truncated_ogive})
      .number("Caliber radius head", nose.caliber_radius_head, {0.5, 100},
              "radius of the ogive's arc in diameters; 0.5 is a hemisphere");
  of_nose({NoseKind::cone})
      .quantity("Nose length", nose.length, Dimension::length, shape_keys::any_length,
                "of a cone, from tip to shaft");
  of_nose({NoseKind::truncated_ogive})
      .quantity("Tip diameter", nose.tip_diameter, Dimension::length, {0, 1e3},
                "of the flat tip of a truncated ogive");
  of_nose({NoseKind::blunt})
      .quantity("Edge radius", nose.edge_radius, Dimension::length, shape_keys::any_length,
                "of the rounded edge of a blunt nose");
  optional.quantity(
      "Nose thickness", nose_thickness, Dimension::length, shape_keys::any_length,
      "of a hollow projectile, from the tip to the cavity; if not set, that of the wall (as the "
      "base). If no thickness is set, the projectile is solid");
  optional.quantity("Base thickness", base_thickness, Dimension::length, shape_keys::any_length,
                    "of a hollow projectile, from the cavity to the tail");
  optional.quantity("Wall thickness", wall_thickness, Dimension::length, shape_keys::any_length,
                    "of a hollow projectile's shaft; if not set, what its mass and density make it");
  optional.file("Profile", profile,
                "file with the contour of a body of revolution; must be set if Shape = profile: CSV with the "
                "columns z,r in m, from one end on "
                "the axis to the other; z may repeat for steps; the tip is the end with the largest z");
  optional.file(
      "File", surface_file,
      "STL file (text or binary) with a closed surface of triangles that does not intersect itself; "
      "must be set if Shape = surface");
  optional.choice("Unit", surface_unit, shape_keys::surface_units,
                  "length that the number 1 in the STL file stands for; must be set if Shape = surface");
}

inline bool ShapeInputs::is_hollow() const {
  return kind == ShapeKind::projectile &&
         !(std::isnan(nose_thickness) && std::isnan(base_thickness) && std::isnan(wall_thickness));
}

inline CasingWalls ShapeInputs::walls() const {
  const auto or_wall = [this](double thickness) {
    return std::isnan(thickness) ? wall_thickness : thickness;
  };
  return {.nose = or_wall(nose_thickness), .base = or_wall(base_thickness), .side = wall_thickness};
}

inline void ShapeInputs::complete_wall(double mass, double density) {
  const bool known = !std::isnan(mass) && !std::isnan(density);
  if (!is_hollow() || !std::isnan(wall_thickness) || !known) return;
  if (std::isnan(nose_thickness) || std::isnan(base_thickness)) return; // validate() says what is missing
  try {
    wall_thickness = side_wall(projectile(), walls(), mass / density);
  } catch (const std::invalid_argument&) {
    wall_thickness = 0; // there is no such projectile: validate() says why
  }
}

inline void ShapeInputs::validate(const std::string& file, const std::string& section) const {
  const auto wrong = [&](const std::string& key, const std::string& why) {
    throw InputError(file + ": key '" + section + "/" + key + "': " + why);
  };
  switch (kind) {
  case ShapeKind::unset:
    wrong("Shape",
          "found 'none', allowed: cylinder, block, projectile, sphere, profile, surface, half space");
    break;
  case ShapeKind::cylinder:
    if (!(hole_diameter < diameter))
      wrong("Hole diameter", "found " + shape_keys::format_length(hole_diameter) +
                                 ", allowed: less than Diameter, " + shape_keys::format_length(diameter));
    break;
  case ShapeKind::profile:
    if (profile.empty()) wrong("Profile", "found '', allowed: a CSV file with the columns z,r");
    read_contour(profile);
    break;
  case ShapeKind::surface:
    if (surface_file.empty()) wrong("File", "found '', allowed: an STL file with a closed surface");
    if (surface_unit == 0) wrong("Unit", "found 'none', allowed: m, cm, mm, in (STL files do not say)");
    ClosedSurface::read(surface_file, surface_unit);
    break;
  case ShapeKind::projectile:
    validate_projectile(wrong);
    break;
  case ShapeKind::block:
  case ShapeKind::sphere:
  case ShapeKind::half_space:
    break;
  }
}

inline void ShapeInputs::validate_projectile(
    const std::function<void(const std::string& key, const std::string& why)>& wrong) const {
  const auto limit = [&](const char* key, double found, const char* other, double most) {
    if (found > most)
      wrong(key, "found " + shape_keys::format_length(found) + ", allowed: at most " + other + ", " +
                     shape_keys::format_length(most));
  };
  if (nose.kind == NoseKind::truncated_ogive && !(nose.tip_diameter < diameter))
    wrong("Tip diameter", "found " + shape_keys::format_length(nose.tip_diameter) +
                              ", allowed: less than Diameter, " + shape_keys::format_length(diameter));
  if (nose.kind == NoseKind::blunt)
    limit("Edge radius", nose.edge_radius, "half of Diameter", 0.5 * diameter);
  if (length < projectile().nose_length())
    wrong("Length", "found " + shape_keys::format_length(length) +
                        ", allowed: at least the length of the nose, " +
                        shape_keys::format_length(projectile().nose_length()));
  if (!is_hollow()) return;
  if (std::isnan(wall_thickness))
    wrong("Wall thickness", "not set; it must be, unless Nose thickness, Base thickness, the mass and the "
                            "density are");
  if (!(wall_thickness > 0))
    wrong("Wall thickness", "no wall makes up the mass at this density with this nose and base");
  limit("Wall thickness", wall_thickness, "half of Diameter", 0.5 * diameter);
  limit("Nose thickness", walls().nose, "Length without Base thickness", length - walls().base);
  try {
    casing(projectile(), walls());
  } catch (const std::invalid_argument& problem) {
    wrong("Nose thickness", "found " + shape_keys::format_length(walls().nose) + " with Wall thickness " +
                                shape_keys::format_length(wall_thickness) + " and Base thickness " +
                                shape_keys::format_length(walls().base) + ": " + problem.what());
  }
}

inline Shape ShapeInputs::shape() const {
  switch (kind) {
  case ShapeKind::cylinder:
    return Cylinder{.radius = 0.5 * diameter, .height = height, .bottom = 0, .hole = 0.5 * hole_diameter};
  case ShapeKind::block:
    return Block{.width = width, .depth = depth, .height = height};
  case ShapeKind::projectile:
    return is_hollow() ? casing(projectile(), walls()) : Revolution{.outer = projectile().contour()};
  case ShapeKind::sphere:
    return Revolution{.outer = sphere_contour(diameter)};
  case ShapeKind::profile:
    return Revolution{.outer = read_contour(profile)};
  case ShapeKind::surface:
    return ClosedSurface::read(surface_file, surface_unit);
  case ShapeKind::half_space:
    return PlaneWall{};
  case ShapeKind::unset:
    break;
  }
  return Nothing{};
}

} // namespace spall
