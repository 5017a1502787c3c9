#include "macro/shape/expected_points.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace spall {
namespace {

using std::numbers::pi;

/// Rings up to which their growth is followed; beyond, all are taken to be as fine as the first one.
constexpr int most_rings = 100000;

/// Points of a ring at radius r with cells of a width, in so many layers.
double of_ring(double r, double width, double layers, bool axis) {
  return layers * (axis ? 1 : std::max(4.0, 2 * pi * r / width));
}

double of_equal_rings(double hole, double radius, double rings, double layers, bool axis) {
  const double width = (radius - hole) / rings;
  return axis ? rings * layers : rings * of_ring(0.5 * (hole + radius), width, layers, false);
}

double of_graded_rings(const Cylinder& c, const Grading& grading, bool axis) {
  const double width = c.radius - c.hole,
               fine = std::min(width, std::max(grading.fine_radius, grading.fine_spacing));
  const auto layers = [&](double spacing) { return std::max(1.0, c.height / spacing); };
  double points = of_equal_rings(c.hole, c.hole + fine, std::max(1.0, fine / grading.fine_spacing),
                                 layers(grading.fine_spacing), axis);
  double r = fine, spacing = grading.fine_spacing;
  for (int ring = 0; r < width; ++ring) {
    if (ring == most_rings)
      return points + of_equal_rings(c.hole + r, c.radius, std::max(1.0, (width - r) / spacing),
                                     layers(spacing), axis);
    spacing = std::min(spacing * grading.growth, grading.coarse_spacing);
    points += of_ring(c.hole + r, spacing, layers(spacing), axis);
    r += spacing;
  }
  return points;
}

double of(const Cylinder& c, const Filling& filling, bool axis) {
  return filling.grading.used() ? of_graded_rings(c, filling.grading, axis)
                                : of_equal_rings(c.hole, c.radius, filling.rings, filling.layers, axis);
}

double of(const Block& block, const Filling& filling, bool) {
  const auto along = [&](double length) { return std::max(1.0, length / filling.spacing); };
  return along(block.width) * along(block.depth) * along(block.height);
}

double of(const Revolution& body, const Filling& filling, bool axis) {
  const double radius = extent(Shape(body), {1, 0, 0}), spacing = body.length() / filling.layers;
  return of_equal_rings(0, radius, std::max<double>(filling.rings, radius / spacing), filling.layers, axis);
}

double of(const ClosedSurface& surface, const Filling& filling, bool) {
  return surface.mass_properties().volume / std::pow(filling.spacing, 3);
}

// Without points.
double of(const PlaneWall&, const Filling&, bool) { return 0; }
double of(const Nothing&, const Filling&, bool) { return 0; }

} // namespace

double expected_points(const Shape& shape, const Filling& filling, const SymmetryPlanes& planes) {
  const double whole = std::visit([&](const auto& s) { return of(s, filling, planes.axis); }, shape);
  return whole / planes.multiplicity();
}

} // namespace spall
