#include "macro/contact/surface_patch.h"

#include "macro/contact/plane_moments.h"

#include <algorithm>
#include <cmath>

namespace spall {
namespace {

/// Smallest allowed cosine between a fitted normal and the direction it was searched from; below it there is
/// no surface.
constexpr double least_agreement = 0.5;

struct Candidate {
  std::uint32_t index;
  double u, v, height; ///< coordinates in the tangent plane and along the normal, from the point, m
  double distance = 0; ///< distance in the tangent plane, in extents of the candidate's cell
  double width = 0;    ///< width of the candidate's cell in the tangent plane, towards the point, m
  double extent = 0;   ///< extent of the candidate's cell along the normal, m
  static constexpr double share = 1;
};

/// Removes all but the outermost candidates. A candidate is hidden if another one lies above it, by half a
/// cell or more along the normal. Points of a plane do not hide each other, even if the normal is tilted by
/// 30 degrees.
void drop_hidden(std::vector<Candidate>& candidates) {
  thread_local std::vector<Candidate> kept;
  kept.clear();
  for (const Candidate& c : candidates) {
    const bool hidden = std::any_of(candidates.begin(), candidates.end(), [&c](const Candidate& above) {
      const double du = above.u - c.u, dv = above.v - c.v, width = facing_radius * c.width;
      return above.height > c.height + 0.5 * c.extent && du * du + dv * dv < width * width;
    });
    if (!hidden && c.distance < patch_radius) kept.push_back(c);
  }
  candidates.swap(kept);
}

/// Finds the patch that is visible along `normal`, and the normal of the plane fitted to it.
bool fit_patch(SurfacePatch& patch, const Vec3& x, const NearPoints& other, double surface_offset,
               const Vec3& normal) {
  thread_local std::vector<Candidate> candidates;
  candidates.clear();
  const auto frame = tangents(normal);
  const Vec3 &tu = frame.first, &tv = frame.second;
  // A point that hides a point of the patch may lie beside the patch.
  const double seen = patch_radius + facing_radius, reach = seen * other.largest_extent(),
               depth = patch_radius * other.largest_extent();
  other.for_each(x, reach, [&](std::uint32_t n, double dx, double dy, double dz) {
    const Vec3 d = {dx, dy, dz};
    const double along = dot(d, normal);
    if (std::abs(along) > depth || dot(d, d) - along * along > reach * reach) return;
    Candidate c{.index = other.indices()[n], .u = dot(d, tu), .v = dot(d, tv), .height = along};
    const double across = std::sqrt(c.u * c.u + c.v * c.v);
    Vec3 lateral = tu;
    if (across > 0)
      for (int k = 0; k < 3; ++k) lateral[k] = (c.u * tu[k] + c.v * tv[k]) / across;
    c.width = other.extent_along(n, lateral);
    c.distance = across / c.width;
    if (c.distance >= seen) return;
    c.extent = other.extent_along(n, normal);
    candidates.push_back(c);
  });
  drop_hidden(candidates);
  const bool faces = std::any_of(candidates.begin(), candidates.end(),
                                 [](const Candidate& c) { return c.distance < facing_radius; });
  if (!faces) return false;

  const PlaneMoments m(candidates);
  patch.points.clear();
  double height = 0, offset = 0, slope_u = 0, slope_v = 0;
  for (const Candidate& c : candidates) {
    const auto [gu, gv] = m.slopes(c);
    const double w = m.weight(c);
    patch.points.push_back({c.index, w});
    height += w * c.height, offset += w * surface_offset * c.extent;
    slope_u += gu * c.height, slope_v += gv * c.height;
  }
  const double cosine = 1 / std::sqrt(1 + slope_u * slope_u + slope_v * slope_v);
  for (int k = 0; k < 3; ++k) patch.normal[k] = cosine * (normal[k] - slope_u * tu[k] - slope_v * tv[k]);
  patch.gap = -height * cosine - offset;
  return true;
}

} // namespace

bool find_patch(SurfacePatch& patch, const Vec3& x, const NearPoints& other, double surface_offset,
                const Vec3& start) {
  if (!fit_patch(patch, x, other, surface_offset, start)) return false;
  // The visible points, and the place of x above them, depend on the direction, so the fit is repeated with
  // the fitted normal.
  const Vec3 fitted = patch.normal;
  return dot(fitted, start) > least_agreement && fit_patch(patch, x, other, surface_offset, fitted);
}

bool is_hidden(const NearPoints& own, std::uint32_t n, const Vec3& x, const Vec3& normal) {
  bool hidden = false;
  own.for_each(x, own.largest_extent(), [&](std::uint32_t k, double dx, double dy, double dz) {
    const Vec3 d = {dx, dy, dz};
    const double below = -dot(d, normal), across = std::sqrt(std::max(0.0, dot(d, d) - below * below));
    if (k == n || !(below > 0.5 * own.extent_along(k, normal))) return;
    Vec3 lateral = normal;
    if (across > 0)
      for (int c = 0; c < 3; ++c) lateral[c] = (d[c] + below * normal[c]) / across;
    hidden = hidden || across < facing_radius * own.extent_along(k, lateral);
  });
  return hidden;
}

} // namespace spall
