#pragma once

#include "macro/shape/projectile.h"
#include "macro/shape/shape.h"
#include "macro/shape/triangles.h"

#include <ostream>
#include <string>
#include <vector>

namespace spall::test {

struct NamedShape {
  std::string name;
  Shape shape;
};
inline void PrintTo(const NamedShape& shape, std::ostream* out) { *out << shape.name; }

/// Makes a projectile with the given nose, 50 mm thick and 200 mm long.
inline Projectile with(const Nose& nose) { return {.diameter = 0.05, .length = 0.2, .nose = nose}; }
inline Shape solid(const Contour& contour) { return Revolution{.outer = contour}; }

/// A body with a narrow front, a cone outwards, a step back inwards and a groove.
inline Contour stepped_contour() {
  return ContourBuilder({0, 0})
      .line_to({0, 0.01})
      .line_to({-0.04, 0.01})
      .line_to({-0.06, 0.03})
      .line_to({-0.1, 0.03})
      .line_to({-0.1, 0.02})
      .line_to({-0.12, 0.02})
      .line_to({-0.12, 0.025})
      .line_to({-0.15, 0.025})
      .line_to({-0.15, 0})
      .contour();
}

/// A body of triangles. It is made once in a program: its distances take time.
inline const ClosedSurface& faceted_cylinder() {
  static const ClosedSurface surface(triangles_of(Cylinder{.radius = 0.05, .height = 0.04}));
  return surface;
}

/// All finite shapes.
inline std::vector<NamedShape> every_shape() {
  return {{"ogive", solid(with({.kind = NoseKind::ogive, .caliber_radius_head = 3}).contour())},
          {"hemisphere", solid(with({.kind = NoseKind::hemisphere}).contour())},
          {"cone", solid(with({.kind = NoseKind::cone, .length = 0.06}).contour())},
          {"truncated_ogive",
           solid(with({.kind = NoseKind::truncated_ogive, .caliber_radius_head = 2, .tip_diameter = 0.02})
                     .contour())},
          {"flat", solid(with({.kind = NoseKind::flat}).contour())},
          {"blunt", solid(with({.kind = NoseKind::blunt, .edge_radius = 0.01}).contour())},
          {"sphere", solid(sphere_contour(0.1))},
          {"stepped", solid(stepped_contour())},
          {"cylinder", Cylinder{.radius = 0.05, .height = 0.04}},
          {"pierced", Cylinder{.radius = 0.05, .height = 0.04, .bottom = -0.01, .hole = 0.01}},
          {"block", Block{.width = 0.05, .depth = 0.08, .height = 0.06}},
          {"triangles", faceted_cylinder()}};
}

} // namespace spall::test
