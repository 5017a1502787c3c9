#pragma once

#include "macro/contact/near_points.h"

namespace spall {

/// A point of the other body and its weight in the patch.
struct PatchPoint {
  std::uint32_t index; ///< index in the body's arrays, images included
  double weight;
};

/// The other body's surface in front of a point, as a plane through its outermost points.
struct SurfacePatch {
  Vec3 normal{};
  double gap = 0;                 ///< distance from the point to the patch along the normal, m
  std::vector<PatchPoint> points; ///< weights add up to one
};

/// A point faces a patch if it is above the cell of one of its points: within half the diagonal of a square
/// cell.
inline constexpr double facing_radius = 0.75;

/// The outermost points of the other body in front of x, and moving least squares of their heights over the
/// tangent plane: the normal is that of the plane that they make, and the weights reproduce linear fields
/// there, so that forces distributed with them conserve the moment about the point. The surface is
/// `surface_offset` extents of a cell above its points.
/// @param start a direction out of the other body, at most about 30 degrees from the normal
/// @return false if x does not face the other body
bool find_patch(SurfacePatch& patch, const Vec3& x, const NearPoints& other, double surface_offset,
                const Vec3& start);

/// True if another point of the own body lies between its n-th point and the patch below it.
bool is_hidden(const NearPoints& own, std::uint32_t n, const Vec3& x, const Vec3& normal);

} // namespace spall
