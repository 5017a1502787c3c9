#pragma once

#include "micro/cell/aggregates.h"
#include "micro/cell/mesh.h"

namespace spall {

/// Where mortar may crack between aggregates.
enum class MortarCracks {
  none,             ///< nowhere: aggregates debond only
  corners,          ///< from the corners of the aggregates to where three mortar rings meet
  corners_and_flats ///< and from the middle of their sides straight to the neighbour's
};

/// Materials and crack lines of a mesh with aggregates: line i is the interface zone of aggregate i, line N +
/// i the ligaments in its mortar ring.
struct AggregateMesh {
  static constexpr unsigned int mortar = 0, aggregate = 1;
  static bool is_interface_zone(int line, std::size_t aggregates) {
    return line < static_cast<int>(aggregates);
  }
};

/// Quadrilaterals only: each side of a polygon has one in the aggregate, from its centre to a corner, and two
/// in the mortar ring. The border of the period is ragged and matches itself one period away.
CellComplex<2> cell_complex(const std::vector<Aggregate>& aggregates, MortarCracks cracks);

} // namespace spall
