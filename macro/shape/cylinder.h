#pragma once

#include "macro/shape/contour.h"

namespace spall {

/// A right circular cylinder on the z axis, from z = bottom to bottom + height: slab, bar, disc.
struct Cylinder {
  double radius = 0, height = 0, bottom = 0; ///< m
  double hole = 0;                           ///< radius of a hole along the axis, m

  SurfacePoint surface(const Vec3& x) const {
    const double r = from_axis(x);
    double ux = r > 0 ? x[0] / r : 1, uy = r > 0 ? x[1] / r : 0;
    double side = r - radius;
    if (hole > 0 && hole - r > side) side = hole - r, ux = -ux, uy = -uy; // the wall of the hole is nearer
    const double up = x[2] - bottom - 0.5 * height, face = std::abs(up) - 0.5 * height, out = up > 0 ? 1 : -1;
    if (side > 0 && face > 0) {
      const double d = std::sqrt(side * side + face * face);
      return {d, {side / d * ux, side / d * uy, out * face / d}};
    }
    return side > face ? SurfacePoint{side, {ux, uy, 0}} : SurfacePoint{face, {0, 0, out}};
  }
  /// Bound of the distance from below, cheap: for skipping points that are far away.
  double lower_bound(const Vec3& x) const {
    return std::max({from_axis(x) - radius, bottom - x[2], x[2] - bottom - height});
  }
  /// Largest projection of a point of the body on a unit vector of its frame, m.
  double extent(const Vec3& direction) const {
    return radius * from_axis(direction) + std::max(bottom * direction[2], (bottom + height) * direction[2]);
  }
  MassProperties mass_properties() const {
    const double axial = (radius * radius + hole * hole) / 2, across = axial / 2 + height * height / 12;
    return {.volume = std::numbers::pi * (radius * radius - hole * hole) * height,
            .centre = {0, 0, bottom + 0.5 * height},
            .moments = {across, across, axial}};
  }
  std::vector<Vec3> surface_samples(double spacing) const { return turned(outline(), spacing); }
  /// From the top along the side to the bottom, and back along the wall of a hole.
  std::vector<ContourPoint> outline() const {
    const double top = bottom + height;
    std::vector<ContourPoint> points = {{top, hole}, {top, radius}, {bottom, radius}, {bottom, hole}};
    if (hole > 0) points.push_back({top, hole});
    return points;
  }
};

} // namespace spall
