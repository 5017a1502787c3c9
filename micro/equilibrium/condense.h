#pragma once

#include "micro/cell/boundary.h"
#include "micro/cell/geometry.h"
#include "micro/equilibrium/condensed_cell.h"

namespace spall {

/// Returns the condensed cell alone, without the bulk's fields. Curves need nothing else. @see Bulk
template<int dim = 2>
CondensedCell<dim> condense(const CellGeometry& geometry, const MeshDensity& density, double poisson_ratio,
                            Boundary boundary = Boundary::periodic);

} // namespace spall
