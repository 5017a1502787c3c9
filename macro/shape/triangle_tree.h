#pragma once

#include "macro/points/tensor.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace spall {

/// A closed surface of triangles, in the frame of its body.
struct Triangles {
  std::vector<Vec3> points;                         ///< m
  std::vector<std::array<std::int64_t, 3>> corners; ///< indices of points, anticlockwise as seen from outside

  /// The corners of one triangle, m.
  std::array<Vec3, 3> triangle(std::size_t f) const {
    return {points[corners[f][0]], points[corners[f][1]], points[corners[f][2]]};
  }
};

/// Answers where a closed surface is nearest and whether a place is inside, with CGAL's tree of bounding
/// boxes. The predicates are exact, so that no place is on the wrong side. May be asked by several threads.
class TriangleTree {
public:
  struct Nearest {
    Vec3 foot;            ///< nearest place of the surface, m
    std::size_t triangle; ///< on which it lies
  };

  /// @param surface closed and not intersecting itself
  explicit TriangleTree(const Triangles& surface);
  Nearest nearest(const Vec3& x) const;
  bool inside(const Vec3& x) const;

private:
  struct Search;
  std::shared_ptr<const Search> search;
};

} // namespace spall
