#pragma once

#include "macro/points/bounds.h"
#include "macro/points/ghosts.h"
#include "macro/points/neighbor_search.h"

namespace spall {

struct KnownSurface;

/// A deformable body with the data that contact needs.
struct ContactBody {
  Points* points;
  const Ghosts* ghosts;
  double bulk = 0, shear = 0; ///< elastic moduli for the contact stress of overlapping kernels, Pa
  /// Known surface of a body that stays whole; null: the surface is fitted through its points.
  const KnownSurface* surface = nullptr;
  /// Ascending numbers of the points; null: their indices.
  const std::vector<std::uint64_t>* numbers = nullptr;

  /// Returns the number that identifies a point in every step.
  std::uint64_t number(std::size_t i) const { return numbers ? (*numbers)[i] : i; }
  /// Maps a vector of the owner of point i to that of the image which point i is.
  Mat3 image_map(std::uint32_t i) const {
    const Vec3 x = ghosts->mirror(*points, i, {1, 0, 0}), y = ghosts->mirror(*points, i, {0, 1, 0}),
               z = ghosts->mirror(*points, i, {0, 0, 1});
    return {x[0], y[0], z[0], x[1], y[1], z[1], x[2], y[2], z[2]};
  }
};

/// Around all points, images included, and `margin` more on every side.
Bounds box_of(const Points& points, double margin);

double largest_spacing(const Points& points); ///< initial, m; 0 if there are no points

/// The points of one body inside a box, sorted for queries. Work is done only where boxes of bodies overlap.
class NearPoints {
public:
  /// Takes the points of the body inside the box, images in symmetry planes included.
  void rebuild(const ContactBody& body, const Bounds& box);

  bool empty() const { return index.empty(); }
  /// Indices in the body's arrays, ascending: owned points first, then images.
  const std::vector<std::uint32_t>& indices() const { return index; }
  /// Extent of the deformed nodal cell of the n-th of them along a unit vector, m.
  double extent_along(std::uint32_t n, const Vec3& direction) const {
    return cell_extent(edges[n], direction, limit);
  }
  double largest_extent() const { return extent; } ///< largest extent of their cells, m
  double largest_spacing() const { return limit / largest_cell_stretch; }
  double spacing(std::uint32_t n) const { return spacings[n]; } ///< initial, m
  Mat3 deformation(std::uint32_t n) const {
    Mat3 f = edges[n];
    for (double& a : f) a /= spacings[n];
    return f;
  }
  /// Calls visit(n, dx, dy, dz) for the points indices()[n] in the box centre +- half.
  template<class Visit> void for_each(const Vec3& centre, double half, const Visit& visit) const {
    search.for_each_in_box(centre, {half, half, half}, visit);
  }

private:
  std::vector<std::uint32_t> index;
  std::vector<double> spacings; ///< m
  std::vector<Mat3> edges;      ///< spacing times deformation gradient, m
  double limit = 0, extent = 0;
  NeighborSearch search;
};

} // namespace spall
