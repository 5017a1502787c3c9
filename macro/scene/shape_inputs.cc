#include "macro/scene/shape_inputs.h"

#include "macro/shape/contour_table.h"
#include "shared/error.h"

#include <stdexcept>

namespace spall {
namespace {

constexpr Range positive_length = {above_zero, 1e3};

std::string text(double length) { return format_quantity(length, Dimension::length); }

[[noreturn]] void refuse(const std::string& file, const std::string& section, const std::string& key,
                         const std::string& why) {
  throw InputError(file + ": key '" + section + "/" + key + "': " + why);
}

} // namespace

void ShapeInputs::declare(Parameters& parameters, const std::string& name,
                          const std::function<bool()>& needed) {
  parameters.section(name).choice(
      "Shape", kind,
      {{"none", ShapeKind::unset},
       {"cylinder", ShapeKind::cylinder},
       {"block", ShapeKind::block},
       {"projectile", ShapeKind::projectile},
       {"sphere", ShapeKind::sphere},
       {"profile", ShapeKind::profile},
       {"half space", ShapeKind::half_space}},
      "of the body; must be set. cylinder: slab, bar, plate, on z = 0 with its axis along z; block: cuboid "
      "on "
      "z = 0; projectile: nose and cylindrical shaft, which flies along +z; sphere; profile: body of "
      "revolution about z whose contour a file gives; half space: everything below z = 0, rigid");
  const auto of = [&](std::initializer_list<ShapeKind> kinds) {
    return parameters.section(name, [this, needed, list = std::vector<ShapeKind>(kinds)] {
      return (!needed || needed()) && std::find(list.begin(), list.end(), kind) != list.end();
    });
  };
  const auto of_nose = [&](std::initializer_list<NoseKind> kinds) {
    return parameters.section(name, [this, needed, list = std::vector<NoseKind>(kinds)] {
      return (!needed || needed()) && kind == ShapeKind::projectile &&
             std::find(list.begin(), list.end(), nose.kind) != list.end();
    });
  };
  auto optional = parameters.section(name, [] { return false; });
  of({ShapeKind::cylinder, ShapeKind::projectile, ShapeKind::sphere})
      .quantity("Diameter", diameter, Dimension::length, positive_length,
                "of a cylinder, of a projectile's shaft, of a sphere");
  of({ShapeKind::cylinder, ShapeKind::block})
      .quantity("Height", height, Dimension::length, positive_length,
                "of a cylinder or block, along z: the thickness of a slab or plate, the length of a bar");
  optional.quantity("Hole diameter", hole_diameter, Dimension::length, {0, 1e3},
                    "of a hole along the axis of a cylinder (a pilot hole); 0: none. Rings are counted from "
                    "its wall");
  auto block = of({ShapeKind::block});
  block.quantity("Width", width, Dimension::length, positive_length, "of a block, along x");
  block.quantity("Depth", depth, Dimension::length, positive_length, "of a block, along y");
  of({ShapeKind::projectile})
      .quantity("Length", length, Dimension::length, positive_length, "of a projectile, from tip to tail");
  parameters.section(name).choice("Nose", nose.kind,
                                  {{"ogive", NoseKind::ogive},
                                   {"hemisphere", NoseKind::hemisphere},
                                   {"cone", NoseKind::cone},
                                   {"truncated ogive", NoseKind::truncated_ogive},
                                   {"flat", NoseKind::flat},
                                   {"blunt", NoseKind::blunt}},
                                  "of a projectile. ogive: pointed, its arc tangent to the shaft; truncated "
                                  "ogive: with a flat tip; blunt: "
                                  "flat with a rounded edge");
  of_nose({NoseKind::ogive, NoseKind::truncated_ogive})
      .number("Caliber radius head", nose.caliber_radius_head, {0.5, 100},
              "radius of the ogive's arc in diameters; 0.5 is a hemisphere");
  of_nose({NoseKind::cone})
      .quantity("Nose length", nose.length, Dimension::length, positive_length,
                "of a cone, from tip to shaft");
  of_nose({NoseKind::truncated_ogive})
      .quantity("Tip diameter", nose.tip_diameter, Dimension::length, {0, 1e3},
                "of the flat tip of a truncated ogive");
  of_nose({NoseKind::blunt})
      .quantity("Edge radius", nose.edge_radius, Dimension::length, positive_length,
                "of the rounded edge of a blunt nose");
  optional.quantity(
      "Nose thickness", nose_thickness, Dimension::length, positive_length,
      "of a hollow projectile, from the tip to the cavity; if not set, that of the wall (as the "
      "base). If no thickness is set, the projectile is solid");
  optional.quantity("Base thickness", base_thickness, Dimension::length, positive_length,
                    "of a hollow projectile, from the cavity to the tail");
  optional.quantity("Wall thickness", wall_thickness, Dimension::length, positive_length,
                    "of a hollow projectile's shaft; if not set, what its mass and density make it");
  auto from_file = parameters.section(name, [] { return false; });
  from_file.file(
      "Profile", profile,
      "file with the contour of a body of revolution: CSV with the columns z,r in m, from one end on "
      "the axis to the other; z may repeat for steps; the tip is the end with the largest z");
}

bool ShapeInputs::is_hollow() const {
  return kind == ShapeKind::projectile &&
         !(std::isnan(nose_thickness) && std::isnan(base_thickness) && std::isnan(wall_thickness));
}

CasingWalls ShapeInputs::walls() const {
  const auto or_wall = [this](double thickness) {
    return std::isnan(thickness) ? wall_thickness : thickness;
  };
  return {.nose = or_wall(nose_thickness), .base = or_wall(base_thickness), .side = wall_thickness};
}

void ShapeInputs::complete_wall(double mass, double density) {
  const bool known = !std::isnan(mass) && !std::isnan(density);
  if (!is_hollow() || !std::isnan(wall_thickness) || !known) return;
  if (std::isnan(nose_thickness) || std::isnan(base_thickness)) return; // validate() says what is missing
  try {
    wall_thickness = side_wall(projectile(), walls(), mass / density);
  } catch (const std::invalid_argument&) {
    wall_thickness = 0; // there is no such projectile: validate() says why
  }
}

void ShapeInputs::validate(const std::string& file, const std::string& section) const {
  const auto wrong = [&](const std::string& key, const std::string& why) { refuse(file, section, key, why); };
  switch (kind) {
  case ShapeKind::unset:
    wrong("Shape", "found 'none', allowed: cylinder, block, projectile, sphere, profile, half space");
    break;
  case ShapeKind::cylinder:
    if (!(hole_diameter < diameter))
      wrong("Hole diameter",
            "found " + text(hole_diameter) + ", allowed: less than Diameter, " + text(diameter));
    break;
  case ShapeKind::profile:
    if (profile.empty()) wrong("Profile", "found '', allowed: a CSV file with the columns z,r");
    read_contour(profile);
    break;
  case ShapeKind::projectile: {
    const auto limit = [&](const char* key, double found, const char* other, double most) {
      if (found > most)
        wrong(key, "found " + text(found) + ", allowed: at most " + other + ", " + text(most));
    };
    if (nose.kind == NoseKind::truncated_ogive && !(nose.tip_diameter < diameter))
      wrong("Tip diameter",
            "found " + text(nose.tip_diameter) + ", allowed: less than Diameter, " + text(diameter));
    if (nose.kind == NoseKind::blunt)
      limit("Edge radius", nose.edge_radius, "half of Diameter", 0.5 * diameter);
    if (length < projectile().nose_length())
      wrong("Length", "found " + text(length) + ", allowed: at least the length of the nose, " +
                          text(projectile().nose_length()));
    if (!is_hollow()) break;
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
      wrong("Nose thickness", "found " + text(walls().nose) + " with Wall thickness " + text(wall_thickness) +
                                  " and Base thickness " + text(walls().base) + ": " + problem.what());
    }
    break;
  }
  case ShapeKind::block:
  case ShapeKind::sphere:
  case ShapeKind::half_space:
    break;
  }
}

Shape ShapeInputs::shape() const {
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
  case ShapeKind::half_space:
    return PlaneWall{};
  case ShapeKind::unset:
    break;
  }
  return Nothing{};
}

void FillingInputs::declare(Parameters& parameters, const std::string& name,
                            const std::function<bool()>& needed) {
  auto section = parameters.section(name, needed);
  section.choice("Layout", filling.layout, {{"polar", Layout::polar}, {"lattice", Layout::lattice}},
                 "of the points of a cylinder. polar: concentric rings in layers; lattice: Cartesian, with a "
                 "staircase for a rim");
  section.integer(
      "Layers", filling.layers, {0, 100000},
      "points over the height of a cylinder (0 only if the spacing is graded), or over the length "
      "of another body of revolution, which also sets their distance around it");
  section.integer(
      "Rings", filling.rings, {0, 100000},
      "points over the radius of a cylinder: concentric rings; 0 only if the spacing is graded. Of "
      "another body of revolution: at least so many through the wall where it is hollow; where it "
      "is solid they follow from Layers");
  section.choice(
      "Boundary points", filling.boundary,
      {{"centred", Boundary::centred}, {"on surface", Boundary::on_surface}},
      "of a cylinder or block: outermost points half a spacing inside, or on the surface with part of a cell "
      "(of a lattice on the end faces only)");
  auto optional = parameters.section(name, [] { return false; });
  optional.quantity(
      "Spacing", filling.spacing, Dimension::length, {above_zero, 1e3},
      "of the points of a block, which lie on a lattice; whole numbers of cells are made to fit");
  Grading& grading = filling.grading;
  optional.quantity(
      "Fine spacing", grading.fine_spacing, Dimension::length, {above_zero, 1e3},
      "of the points near the axis of a cylinder, if the spacing is graded (instead of Rings and "
      "Layers; polar only); the keys below go with it");
  auto graded =
      parameters.section(name, [this, needed] { return filling.grading.used() && (!needed || needed()); });
  graded.quantity("Fine radius", grading.fine_radius, Dimension::length, {0, 1e3},
                  "as far as which the fine spacing goes");
  graded.number("Growth", grading.growth, {1, 2}, "widest of two neighbouring rings over the other");
  graded.quantity("Coarse spacing", grading.coarse_spacing, Dimension::length, {above_zero, 1e3},
                  "largest spacing, at the rim");
  section.number(
      "Jitter", filling.jitter.amount, {0, 0.95},
      "random displacement of the points of a cylinder or block, as part of the way to the wall of "
      "their cell");
  section.integer("Jitter seed", filling.jitter.seed, {0, 1000000}, "of the random displacement");
}

void FillingInputs::validate(const std::string& file, const std::string& section, const Shape& shape) const {
  const Cylinder* cylinder = std::get_if<Cylinder>(&shape);
  if (cylinder != nullptr) return validate_cylinder(file, section, *cylinder);
  if (filling.layout == Layout::lattice && !std::holds_alternative<Block>(shape))
    refuse(file, section, "Layout", "found 'lattice', allowed for this shape: polar");
  if (filling.grading.used())
    refuse(file, section, "Fine spacing",
           "found " + text(filling.grading.fine_spacing) + ", allowed: with Shape = cylinder only");
  if (std::holds_alternative<Block>(shape)) return validate_block(file, section);
  if (const Revolution* body = std::get_if<Revolution>(&shape))
    return validate_revolution(file, section, body->inner.has_value());
  refuse(file, section, "Shape", "a body without end cannot be deformable");
}

void FillingInputs::validate_cylinder(const std::string& file, const std::string& section,
                                      const Cylinder& shape) const {
  if (shape.hole > 0 && filling.layout == Layout::lattice)
    refuse(file, section, "Hole diameter",
           "found " + text(2 * shape.hole) + ", allowed: 0 with Layout = lattice");
  if (filling.grading.used()) return validate_grading(file, section, shape);
  const int fewest = filling.boundary == Boundary::on_surface ? 2 : 1;
  if (filling.layers < fewest)
    refuse(file, section, "Layers",
           "found " + std::to_string(filling.layers) + ", allowed: at least " + std::to_string(fewest) +
               (fewest > 1 ? " (points on both faces)" : ", or a Fine spacing instead of Rings and Layers"));
  if (filling.rings < 1)
    refuse(file, section, "Rings",
           "found 0, allowed: at least 1, or a Fine spacing instead of Rings and Layers");
}

void FillingInputs::validate_grading(const std::string& file, const std::string& section,
                                     const Cylinder& shape) const {
  const Grading& grading = filling.grading;
  if (filling.layout == Layout::lattice)
    refuse(file, section, "Layout",
           "a lattice has one spacing; Fine spacing (" + text(grading.fine_spacing) + ") wants polar");
  if (filling.rings > 0 || filling.layers > 0)
    refuse(file, section, "Fine spacing",
           "the spacing is either graded, " + text(grading.fine_spacing) +
               " at the axis, or given by Rings and Layers (" + std::to_string(filling.rings) + ", " +
               std::to_string(filling.layers) + "): set these to 0, or leave it out");
  if (grading.coarse_spacing < grading.fine_spacing)
    refuse(file, section, "Coarse spacing",
           "found " + text(grading.coarse_spacing) + ", allowed: at least Fine spacing, " +
               text(grading.fine_spacing));
  if (grading.coarse_spacing > shape.height / 2)
    refuse(file, section, "Coarse spacing",
           "found " + text(grading.coarse_spacing) + ", allowed: at most half of Height, " +
               text(shape.height / 2) + " (a single layer cannot bend)");
}

void FillingInputs::validate_revolution(const std::string& file, const std::string& section,
                                        bool hollow) const {
  if (filling.boundary == Boundary::on_surface)
    refuse(file, section, "Boundary points", "found 'on surface', allowed for this shape: centred");
  if (filling.jitter.amount > 0)
    refuse(file, section, "Jitter", "found more than 0, which only cylinders and blocks can have");
  if (filling.layers < 1) refuse(file, section, "Layers", "found 0, allowed: at least 1");
  if (hollow && filling.rings < 1)
    refuse(file, section, "Rings", "found 0, allowed: at least 1 (points through the wall)");
}

void FillingInputs::validate_block(const std::string& file, const std::string& section) const {
  if (std::isnan(filling.spacing))
    refuse(file, section, "Spacing", "not set; a deformable block must have one");
}

} // namespace spall
