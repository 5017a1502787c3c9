#pragma once

#include "micro/cell/geometry.h"

#include <array>
#include <vector>

namespace spall {

/// Mesh of the unit cube with a circular crack in its middle plane y = 1/2: a plane mesh over x and z that
/// resolves the circle, repeated at each height.
struct PennyGrid {
  std::vector<std::array<double, 2>> vertices; ///< coordinates x, z
  /// Vertex numbers in lexicographic order: along the first direction, then along the second.
  std::vector<std::array<unsigned int, 4>> quads;
  std::vector<bool> open;      ///< for each quadrilateral: whether it lies within the crack
  std::vector<double> heights; ///< y of the planes of vertices, ascending from 0 to 1, with 1/2 among them
};

/// Meshes the plane of the crack with a square in the middle of the crack, rings of elements from it to the
/// crack front, and rings from there to the edge of the cell. Each ring has 4 * density.elements
/// quadrilaterals, graded towards the front as in a plane cell. The front is a polygon of the circle's area,
/// so that the area of the ligament is exact.
/// @pre 0 < geometry.crack_ratio <= 0.9, density.elements >= 2
PennyGrid penny_grid(const CellGeometry& geometry, const MeshDensity& density);

/// Longest side of an element on the ligament, as a fraction of the cell's edge.
double coarsest_ligament_element(const PennyGrid& grid);

} // namespace spall
