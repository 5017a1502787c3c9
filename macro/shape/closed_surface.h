#pragma once

#include "macro/shape/contour.h"
#include "macro/shape/triangle_tree.h"

#include <filesystem>
#include <memory>

namespace spall {

/// A body whose surface is triangles of a file. Distances are those to the triangles, without error; corners
/// and edges stay sharp. The normal is that from the nearest place of the surface, on the surface that of the
/// triangle.
class ClosedSurface {
public:
  /// @param surface closed, not intersecting itself, anticlockwise as seen from outside
  /// @param turned whether the file had it inside out
  explicit ClosedSurface(Triangles surface, bool turned = false);
  /// Reads an STL file (stl_file.h), once for all who ask for the same file and unit.
  /// @throws InputError
  static ClosedSurface read(const std::filesystem::path& file, double unit);

  SurfacePoint surface(const Vec3& x) const;
  /// The distance from the box around the body, or a known distance nearby less the way from there.
  double lower_bound(const Vec3& x) const;
  double extent(const Vec3& direction) const;
  /// By the divergence theorem: sums over the tetrahedra between a place and each triangle.
  const MassProperties& mass_properties() const { return body->mass; }
  std::vector<Vec3> surface_samples(double spacing) const;
  /// The largest radius about z of sections, as if the body was turned.
  std::vector<ContourPoint> outline() const;

  const Triangles& triangles() const { return body->triangles; }
  bool was_turned() const { return body->turned; }
  const Vec3& low() const { return body->low; }   ///< lowest corner of the box around it, m
  const Vec3& high() const { return body->high; } ///< highest corner, m
  /// Largest distance of a corner's mirror image from the surface, m. @param axis across the mirror: 0 or 1
  double asymmetry(int axis) const;

private:
  /// What all copies share.
  struct Body {
    Triangles triangles;
    bool turned;
    TriangleTree tree;
    Vec3 low, high;
    MassProperties mass = {};
    // Signed distances at the nodes of a grid over the box.
    double step = 0;                    ///< m
    std::array<std::size_t, 3> nodes{}; ///< along each axis
    std::vector<double> distance = {};  ///< x fastest, m

    Body(Triangles triangles_, bool turned_);
    SurfacePoint surface(const Vec3& x) const;
    void fill_grid();
  };
  std::shared_ptr<const Body> body;
};

} // namespace spall
