#include "micro/cell/aggregate_mesh.h"

namespace spall {
namespace {

/// Distance below which two vertices are the same, in units of the cell: far below any element, far above
/// round-off.
constexpr double same_place = 1e-9;

} // namespace

CellComplex<2> cell_complex(const std::vector<Aggregate>& aggregates, MortarCracks cracks) {
  CellComplex<2> complex;
  complex.periods[0][0] = complex.periods[1][1] = 1;
  // Vertices on the sides of the polygons are shared with neighbours.
  std::vector<unsigned int> shared;
  const auto add = [&](const Eigen::Vector2d& at, bool is_shared) {
    const dealii::Point<2> point(at[0], at[1]);
    for (const unsigned int v : shared)
      if (is_shared && complex.vertices[v].distance(point) < same_place) return v;
    const auto number = static_cast<unsigned int>(complex.vertices.size());
    complex.vertices.push_back(point);
    if (is_shared) shared.push_back(number);
    return number;
  };
  std::vector<CrackFace<2>> interface_zone;
  const int count = static_cast<int>(aggregates.size());
  for (int i = 0; i < count; ++i) {
    const Aggregate& a = aggregates[i];
    const std::size_t n = a.corners.size();
    /// Vertices at a corner and at the middle of the side that starts there, on both edges of the ring.
    struct Side {
      unsigned int corner, middle, inner_corner, inner_middle;
    };
    std::vector<Side> sides;
    const auto inner = [&](const Eigen::Vector2d& at) {
      return Eigen::Vector2d(a.centre + a.scale * (at - a.centre));
    };
    for (std::size_t k = 0; k < n; ++k) {
      const Eigen::Vector2d &corner = a.corners[k], middle = 0.5 * (corner + a.corners[(k + 1) % n]);
      sides.push_back({.corner = add(corner, true),
                       .middle = add(middle, true),
                       .inner_corner = add(inner(corner), false),
                       .inner_middle = add(inner(middle), false)});
    }
    const unsigned int centre = add(a.centre, false);
    for (std::size_t k = 0; k < n; ++k) {
      const Side &here = sides[k], &before = sides[(k + n - 1) % n];
      const auto cell = [&](const std::array<unsigned int, 4>& vertices, unsigned int material) {
        complex.cells.push_back(vertices);
        complex.materials.push_back(material);
      };
      cell({centre, before.inner_middle, here.inner_middle, here.inner_corner}, AggregateMesh::aggregate);
      cell({before.inner_middle, before.middle, here.inner_corner, here.corner}, AggregateMesh::mortar);
      cell({here.inner_corner, here.corner, here.inner_middle, here.middle}, AggregateMesh::mortar);
      if (cracks != MortarCracks::none)
        complex.cracks.push_back({.vertices = {here.inner_corner, here.corner}, .line = count + i});
      if (cracks == MortarCracks::corners_and_flats)
        complex.cracks.push_back({.vertices = {here.inner_middle, here.middle}, .line = count + i});
      // The vertices run clockwise around the aggregate, so that the mortar is the upper side.
      interface_zone.push_back({.vertices = {here.inner_corner, before.inner_middle}, .line = i});
      interface_zone.push_back({.vertices = {here.inner_middle, here.inner_corner}, .line = i});
    }
  }
  // The stronger mortar cracks come first: where they meet the interface zone they keep their laws (see
  // CrackPair), and the whole zone keeps its own as long as they are closed.
  complex.cracks.insert(complex.cracks.end(), interface_zone.begin(), interface_zone.end());
  return complex;
}

} // namespace spall
