#include "macro/scene/filling_inputs.h"

#include "shared/error.h"

namespace spall {
namespace {

std::string text(double length) { return format_quantity(length, Dimension::length); }

[[noreturn]] void refuse(const std::string& file, const std::string& section, const std::string& key,
                         const std::string& why) {
  throw InputError(file + ": key '" + section + "/" + key + "': " + why);
}

} // namespace

void FillingInputs::declare(Parameters& parameters, const std::string& name, const Needed& needed) {
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
  auto optional = parameters.section(name, Needed::never());
  optional.quantity(
      "Spacing", filling.spacing, Dimension::length, {above_zero, 1e3},
      "of the points of a block or surface, which lie on a lattice; must be set for these shapes; "
      "whole numbers of cells are made to fit the block, or the box around the surface");
  Grading& grading = filling.grading;
  optional.quantity(
      "Fine spacing", grading.fine_spacing, Dimension::length, {above_zero, 1e3},
      "of the points near the axis of a cylinder, if the spacing is graded (instead of Rings and "
      "Layers; polar only); the keys below go with it");
  auto graded = parameters.section(
      name, Needed{[this] { return filling.grading.used(); }, "Fine spacing is set"} && needed);
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
  if (filling.layout == Layout::lattice && std::holds_alternative<Revolution>(shape))
    refuse(file, section, "Layout", "found 'lattice', allowed for this shape: polar");
  if (filling.grading.used())
    refuse(file, section, "Fine spacing",
           "found " + text(filling.grading.fine_spacing) + ", allowed: with Shape = cylinder only");
  if (std::holds_alternative<Block>(shape)) return validate_block(file, section);
  if (const ClosedSurface* body = std::get_if<ClosedSurface>(&shape))
    return validate_surface(file, section, *body);
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

void FillingInputs::validate_surface(const std::string& file, const std::string& section,
                                     const ClosedSurface& shape) const {
  if (std::isnan(filling.spacing))
    refuse(file, section, "Spacing", "not set; a deformable body of Shape = surface must have one");
  if (filling.boundary == Boundary::on_surface)
    refuse(file, section, "Boundary points", "found 'on surface', allowed for this shape: centred");
  if (filling.jitter.amount > 0)
    refuse(file, section, "Jitter", "found more than 0, which only cylinders and blocks can have");
  try {
    fill_surface(shape, filling, {}, 1);
  } catch (const std::invalid_argument& problem) {
    refuse(file, section, "Spacing", "found " + text(filling.spacing) + ": " + problem.what());
  }
}

} // namespace spall
