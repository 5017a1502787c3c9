#pragma once

#include "micro/cell/geometry.h"

#include <deal.II/base/types.h>
#include <deal.II/grid/tria.h>

namespace spall {

/// Boundary numbers of the cell's mesh. A crack line is a pair of boundaries that lie on each other.
struct CellBoundary {
  static constexpr dealii::types::boundary_id left = 0, right = 1, bottom = 2, top = 3;
  static constexpr dealii::types::boundary_id crack_lower(unsigned int line) { return 4 + 2 * line; }
  static constexpr dealii::types::boundary_id crack_upper(unsigned int line) { return 5 + 2 * line; }
};

/// Fills an empty triangulation with the unit cell. The nodes of the whole crack lines, initial cracks and
/// ligaments, are there twice: once for the faces below, once for those above.
void make_cell_mesh(const CellGrid& grid, dealii::Triangulation<2>& mesh);

} // namespace spall
