#pragma once

#include "macro/shape/contour.h"

namespace spall {

/// A cuboid, centred on the z axis, from z = 0 to its height.
struct Block {
  double width = 0, depth = 0, height = 0; ///< along x, y, z, m

  SurfacePoint surface(const Vec3& x) const {
    const Vec3 from_centre = {x[0], x[1], x[2] - 0.5 * height},
               half = {0.5 * width, 0.5 * depth, 0.5 * height};
    Vec3 beyond, outward;
    int nearest = 0;
    double square = 0; // of the distance of a point outside
    for (int c = 0; c < 3; ++c) {
      beyond[c] = std::abs(from_centre[c]) - half[c];
      outward[c] = from_centre[c] < 0 ? -1 : 1;
      if (beyond[c] > beyond[nearest]) nearest = c;
      if (beyond[c] > 0) square += beyond[c] * beyond[c];
    }
    SurfacePoint at{beyond[nearest], {}};
    if (square == 0) {
      at.normal[nearest] = outward[nearest];
      return at;
    }
    at.distance = std::sqrt(square);
    for (int c = 0; c < 3; ++c) at.normal[c] = outward[c] * std::max(0.0, beyond[c]) / at.distance;
    return at;
  }
  /// Bound of the distance from below, cheap: for skipping points that are far away.
  double lower_bound(const Vec3& x) const {
    return std::max({std::abs(x[0]) - 0.5 * width, std::abs(x[1]) - 0.5 * depth, -x[2], x[2] - height});
  }
  /// Largest projection of a point of the body on a unit vector of its frame, m.
  double extent(const Vec3& direction) const {
    return 0.5 * width * std::abs(direction[0]) + 0.5 * depth * std::abs(direction[1]) +
           std::max(0.0, height * direction[2]);
  }
  MassProperties mass_properties() const {
    const double w = width * width / 12, d = depth * depth / 12, h = height * height / 12;
    return {
        .volume = width * depth * height, .centre = {0, 0, 0.5 * height}, .moments = {d + h, w + h, w + d}};
  }
  std::vector<Vec3> surface_samples(double spacing) const {
    const Vec3 size = {width, depth, height};
    std::array<int, 3> n;
    for (int c = 0; c < 3; ++c) n[c] = segments(size[c], spacing);
    std::vector<Vec3> samples;
    for (int i = 0; i <= n[0]; ++i)
      for (int j = 0; j <= n[1]; ++j)
        for (int k = 0; k <= n[2]; ++k) {
          const bool on_surface = i == 0 || i == n[0] || j == 0 || j == n[1] || k == 0 || k == n[2];
          if (on_surface)
            samples.push_back(
                {size[0] * i / n[0] - 0.5 * size[0], size[1] * j / n[1] - 0.5 * size[1], size[2] * k / n[2]});
        }
    return samples;
  }
  /// Of the section in the x-z plane, whose r is x.
  std::vector<ContourPoint> outline() const {
    return {{height, 0}, {height, 0.5 * width}, {0, 0.5 * width}, {0, 0}};
  }
};

} // namespace spall
