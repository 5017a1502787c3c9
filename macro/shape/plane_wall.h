#pragma once

#include "macro/shape/contour.h"

namespace spall {

/// The half space z < 0: a rigid wall or foundation.
struct PlaneWall {
  SurfacePoint surface(const Vec3& x) const { return {x[2], {0, 0, 1}}; }
  double lower_bound(const Vec3& x) const { return x[2]; }
  double extent(const Vec3& direction) const {
    const bool up = direction[0] == 0 && direction[1] == 0 && direction[2] >= 0;
    return up ? 0 : std::numeric_limits<double>::infinity();
  }
  MassProperties mass_properties() const { return {.volume = std::numeric_limits<double>::infinity()}; }
  std::vector<Vec3> surface_samples(double) const { return {}; }
  std::vector<ContourPoint> outline() const { return {}; }
};

/// No body: everything is far from it.
struct Nothing {
  SurfacePoint surface(const Vec3&) const { return {std::numeric_limits<double>::infinity(), {0, 0, 1}}; }
  double lower_bound(const Vec3&) const { return std::numeric_limits<double>::infinity(); }
  double extent(const Vec3&) const { return -std::numeric_limits<double>::infinity(); }
  MassProperties mass_properties() const { return {}; }
  std::vector<Vec3> surface_samples(double) const { return {}; }
  std::vector<ContourPoint> outline() const { return {}; }
};

} // namespace spall
