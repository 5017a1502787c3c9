#pragma once

#include "macro/contact/rigid_body.h"
#include "macro/contact/surface_patch.h"

namespace spall {

/// The surface of a body that stays whole. It is known before the impact; afterwards it is where the body's
/// points have carried it. So it stays smooth however coarse the points are and whatever they touch: a fit
/// through the outermost points has to find out what is a surface at every step, and finds steps at the nose
/// where the ogive curves within a few points.
struct KnownSurface {
  Shape shape;
  Mat3 axes = identity3; ///< axes of the shape's frame at the start, as columns in space
  Vec3 origin{};         ///< origin of the shape's frame at the start, m
  /// For each of the body's points: whether it carries the surface and takes its forces.
  std::vector<bool> outermost;

  /// Finds the outermost of the body's points, or of this rank's.
  void mark(const Points& points);
  SurfacePoint at(const Vec3& initial) const {
    const SurfacePoint local = std::visit(
        [&](const auto& s) { return s.surface(times_transposed(axes, add(initial, -1, origin))); }, shape);
    return {local.distance, times(axes, local.normal)};
  }
};

/// With the points less than so many of their spacings below the surface as its outermost.
inline constexpr double outermost_depth = 0.75;
KnownSurface known_surface(const Shape& shape, const Mat3& axes, const Vec3& origin, const Points& points);

/// The patch of the carried surface nearest to x. The map from the start to now is linear about the nearest
/// point of the body, which gives the foot on the surface at the start, and then the mean over the outermost
/// points about that foot of their own linear maps (their deformation gradients), which carries foot and
/// normal to where they are now. The weights are those of the mean: kernels about the foot, corrected so that
/// they reproduce linear fields over the tangent plane, times the points' masses.
/// @param load_radius over which the force on the surface is spread if that is more than the points' own
/// patch, m
/// @param reach largest distance of points that are looked at, m
/// @return false if no point of the body is near
bool find_carried_patch(SurfacePatch& patch, const Vec3& x, const ContactBody& body, const NearPoints& near,
                        double load_radius, double reach);

} // namespace spall
