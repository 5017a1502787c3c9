#pragma once

#include "micro/cell/geometry.h"

#include <array>
#include <vector>

namespace spall {

/// Mesh of the unit cube with a circular crack in its middle plane y = 1/2: a plane mesh over x and z that
/// resolves the circle, repeated at each height.
struct PennyGrid {
  std::vector<std::array<double, 2>> vertices; ///< x, z
  std::vector<std::array<unsigned int, 4>>
      quads;                   ///< lexicographic: along the first direction, then the other
  std::vector<bool> open;      ///< per quad: within the crack
  std::vector<double> heights; ///< ascending from 0 to 1, with 1/2 among them
};

/// A square in the middle of the crack, rings around it up to the crack front, rings from there to the edge
/// of the cell, each of 4 * density.elements quads, graded towards the front like a plane cell's. The front
/// is a polygon of the circle's area, so that the ligament has its exact area.
/// @pre 0 < geometry.crack_ratio <= 0.9, density.elements >= 2
PennyGrid penny_grid(const CellGeometry& geometry, const MeshDensity& density);

/// Longest side of an element on the ligament, as a fraction of the cell's edge.
double coarsest_ligament_element(const PennyGrid& grid);

} // namespace spall
