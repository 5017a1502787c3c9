#pragma once

#include "macro/points/points.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

namespace spall {

/// Signed distance to a surface (negative inside the rigid body) and its outward normal, in the body's frame.
struct SurfacePoint {
  double distance;
  Vec3 normal;
};

/// The half space z < 0: the anvil of a Taylor test.
struct PlaneWall {
  SurfacePoint surface(const Vec3& x) const { return {x[2], {0, 0, 1}}; }
  /// Bound of the distance from below, cheap: for skipping points that are far away.
  double lower_bound(const Vec3& x) const { return x[2]; }
};

/// Projectile with a tangent ogive nose and a cylindrical body, axis along z, tip at z = 0, tail at z =
/// -length: it flies along +z. The nose is an arc of radius `ogive_radius` (calibre radius head times the
/// diameter) turned about the axis.
struct Ogive {
  double radius = 0, length = 0, ogive_radius = 0; ///< m

  double nose_length() const {
    const double d = ogive_radius - radius;
    return std::sqrt(ogive_radius * ogive_radius - d * d);
  }
  SurfacePoint surface(const Vec3& x) const {
    const double r = std::hypot(x[0], x[1]), z = x[2];
    // A point on the axis has no radial direction; any will do.
    const double ux = r > 0 ? x[0] / r : 1, uy = r > 0 ? x[1] / r : 0;
    const auto along = [&](double distance, double nr, double nz) {
      return SurfacePoint{distance, {nr * ux, nr * uy, nz}};
    };
    const double shoulder = -nose_length(),
                 centre = radius - ogive_radius; // of the arc: r = centre, z = shoulder
    if (z > shoulder) {
      const double dr = r - centre, dz = z - shoulder, d = std::hypot(dr, dz);
      // Ahead of the normal cone of the tip the nearest point is the tip itself.
      if (dz * -centre > dr * nose_length()) {
        const double t = std::hypot(r, z);
        if (t > 0) return along(t, r / t, z / t);
      }
      return along(d - ogive_radius, dr / d, dz / d);
    }
    const double side = r - radius, tail = -length - z;
    if (side > 0 && tail > 0) {
      const double d = std::hypot(side, tail);
      return along(d, side / d, -tail / d);
    }
    return side > tail ? along(side, 1, 0) : along(tail, 0, -1);
  }
  double lower_bound(const Vec3& x) const {
    return std::max({std::hypot(x[0], x[1]) - radius, x[2], -length - x[2]});
  }
  /// Radius of the section at z, m.
  double section_radius(double z) const {
    if (z > 0 || z < -length) return 0;
    const double dz = std::max(0.0, z + nose_length());
    return radius - ogive_radius + std::sqrt(ogive_radius * ogive_radius - dz * dz);
  }
  /// Largest projection of a point of the body on a unit vector of its frame, m.
  double extent(const Vec3& direction) const {
    const double across = std::hypot(direction[0], direction[1]), along = direction[2];
    const double rim = radius * across + std::max(-length * along, -nose_length() * along);
    // The arc has this normal somewhere between the shoulder and the tip.
    const double centre = radius - ogive_radius;
    const bool on_arc = along > 0 && ogive_radius * across > -centre;
    return std::max({0.0, rim, on_arc ? ogive_radius + centre * across - nose_length() * along : 0.0});
  }
};

/// A disc about z, from z = 0 to its thickness.
struct Disc {
  double radius = 0, thickness = 0; ///< m

  SurfacePoint surface(const Vec3& x) const {
    const double r = std::hypot(x[0], x[1]), ux = r > 0 ? x[0] / r : 1, uy = r > 0 ? x[1] / r : 0;
    const double side = r - radius, up = x[2] - 0.5 * thickness, face = std::abs(up) - 0.5 * thickness,
                 out = up > 0 ? 1 : -1;
    if (side > 0 && face > 0) {
      const double d = std::hypot(side, face);
      return {d, {side / d * ux, side / d * uy, out * face / d}};
    }
    return side > face ? SurfacePoint{side, {ux, uy, 0}} : SurfacePoint{face, {0, 0, out}};
  }
  double lower_bound(const Vec3& x) const {
    return std::max({std::hypot(x[0], x[1]) - radius, -x[2], x[2] - thickness});
  }
};

/// No body: everything is far from it.
struct Nothing {
  SurfacePoint surface(const Vec3&) const { return {std::numeric_limits<double>::infinity(), {0, 0, 1}}; }
  double lower_bound(const Vec3&) const { return std::numeric_limits<double>::infinity(); }
};

using RigidShape = std::variant<PlaneWall, Ogive, Disc, Nothing>;

} // namespace spall
