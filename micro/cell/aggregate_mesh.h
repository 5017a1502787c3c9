#pragma once

#include "micro/cell/aggregates.h"
#include "micro/cell/mesh.h"

namespace spall {

/// Material numbers of a mesh with aggregates. Crack line i is the interface zone of aggregate i, crack line
/// N + i the ligaments in its mortar ring (N: number of aggregates).
struct AggregateMesh {
  static constexpr unsigned int mortar = 0, aggregate = 1;
};

/// Meshes the packed aggregates with quadrilaterals only: each side of a polygon has one in the aggregate,
/// from its centre to a corner, and two in the mortar ring. The border of the periodic cell follows the
/// polygons instead of a square; each part of it coincides with its image one period away.
CellComplex<2> cell_complex(const std::vector<Aggregate>& aggregates, MortarCracks cracks);

} // namespace spall
