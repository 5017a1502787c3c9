#include "macro/contact/carried_surface.h"

#include "macro/contact/plane_moments.h"

#include <algorithm>
#include <cmath>

namespace spall {
namespace {

struct Candidate {
  std::uint32_t near;  ///< number of the candidate among the near points
  Vec3 now, initial;   ///< m
  double u = 0, v = 0; ///< coordinates of the initial place in the tangent plane at the foot, m
  double distance = 0; ///< distance of the initial place from the foot, in extents of the cell
  double share = 0; ///< share in a force on the patch: the mass, kg, so that all points of the patch get the
                    ///< same acceleration
};

} // namespace

KnownSurface known_surface(const Shape& shape, const Mat3& axes, const Vec3& origin, const Points& points) {
  KnownSurface surface{.shape = shape, .axes = axes, .origin = origin, .outermost = {}};
  surface.mark(points);
  return surface;
}

void KnownSurface::mark(const Points& points) {
  outermost.clear();
  for (std::size_t i = 0; i < points.owned; ++i)
    outermost.push_back(-at(points.initial_position[i]).distance < outermost_depth * points.spacing[i]);
}

bool find_carried_patch(SurfacePatch& patch, const Vec3& x, const ContactBody& body, const NearPoints& near,
                        double load_radius, double reach) {
  thread_local std::vector<Candidate> all, close;
  all.clear();
  const Points& points = *body.points;
  double least = reach * reach;
  std::size_t nearest = 0;
  near.for_each(x, reach, [&](std::uint32_t n, double dx, double dy, double dz) {
    const double square = dx * dx + dy * dy + dz * dz;
    const std::uint32_t i = near.indices()[n], owner = body.ghosts->owner(points, i);
    if (square >= reach * reach || !body.surface->outermost[owner]) return;
    if (square < least) least = square, nearest = all.size();
    all.push_back({.near = n,
                   .now = {x[0] + dx, x[1] + dy, x[2] + dz},
                   .initial = body.ghosts->mirror(points, i, points.initial_position[owner]),
                   .share = points.mass[owner]});
  });
  if (all.empty()) return false;

  const Candidate& first = all[nearest];
  const Vec3 guess =
      add(first.initial, 1, times(inverse(near.deformation(first.near)), add(x, -1, first.now)));
  const SurfacePoint surface = body.surface->at(guess);
  const Vec3 foot = add(guess, -surface.distance, surface.normal);

  const auto [tu, tv] = tangents(surface.normal);
  const double radius = std::max(patch_radius * near.spacing(first.near), load_radius);
  close.clear();
  for (Candidate c : all) {
    const Vec3 d = add(c.initial, -1, foot);
    c.u = dot(d, tu), c.v = dot(d, tv);
    c.distance = patch_radius * std::sqrt(dot(d, d)) / radius;
    if (c.distance < patch_radius) close.push_back(c);
  }
  if (close.empty()) return false;

  const PlaneMoments m(close);
  patch.points.clear();
  Vec3 carried{};
  Mat3 map{};
  for (const Candidate& c : close) {
    const double w = m.weight(c);
    const Mat3 f = near.deformation(c.near);
    patch.points.push_back({near.indices()[c.near], w});
    carried = add(carried, w, add(c.now, 1, times(f, add(foot, -1, c.initial))));
    for (int k = 0; k < 9; ++k) map[k] += w * f[k];
  }
  patch.normal = unit(times_transposed(inverse(map), surface.normal));
  patch.gap = dot(add(x, -1, carried), patch.normal);
  return true;
}

} // namespace spall
