#pragma once

#include "macro/shape/block.h"
#include "macro/shape/closed_surface.h"
#include "macro/shape/cylinder.h"
#include "macro/shape/plane_wall.h"
#include "macro/shape/revolution.h"

#include <variant>

namespace spall {

/// What a body looks like, in its own frame. A rigid body meets the points of others with the surface of its
/// shape; a deformable one is filled with points (fill.h), and its surface is the shape's at the start. Every
/// shape has
///   SurfacePoint surface(const Vec3& x) const          signed distance and normal; called at every point
///   double lower_bound(const Vec3& x) const            never more than that distance, and cheap
///   double extent(const Vec3& direction) const         largest projection on a unit vector, m
///   MassProperties mass_properties() const             of a homogeneous body
///   std::vector<Vec3> surface_samples(double spacing) const  to see whether two bodies overlap
///   std::vector<ContourPoint> outline() const          for pictures, from the largest z to the smallest
/// Loops over points visit the variant outside of the loop, so that `surface` is compiled into it.
using Shape = std::variant<PlaneWall, Cylinder, Block, Revolution, ClosedSurface, Nothing>;

inline double extent(const Shape& shape, const Vec3& direction) {
  return std::visit([&](const auto& s) { return s.extent(direction); }, shape);
}
inline SurfacePoint surface(const Shape& shape, const Vec3& x) {
  return std::visit([&](const auto& s) { return s.surface(x); }, shape);
}
inline double lower_bound(const Shape& shape, const Vec3& x) {
  return std::visit([&](const auto& s) { return s.lower_bound(x); }, shape);
}
inline MassProperties mass_properties(const Shape& shape) {
  return std::visit([](const auto& s) { return s.mass_properties(); }, shape);
}
inline std::vector<ContourPoint> outline(const Shape& shape) {
  return std::visit([](const auto& s) { return s.outline(); }, shape);
}
/// Whether the shape has rotational symmetry about z (a block has not, and triangles never quite).
inline bool is_round(const Shape& shape) {
  return !std::holds_alternative<Block>(shape) && !std::holds_alternative<ClosedSurface>(shape);
}

/// Points on the surface, at most about `spacing` apart and with all corners. None for shapes without end.
inline std::vector<Vec3> surface_samples(const Shape& shape, double spacing) {
  return std::visit([&](const auto& s) { return s.surface_samples(spacing); }, shape);
}

} // namespace spall
