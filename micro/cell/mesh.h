#pragma once

#include "micro/cell/geometry.h"

#include <deal.II/base/types.h>
#include <deal.II/grid/tria.h>

namespace spall {

/// Boundary numbers of the cell's mesh. The crack line is a pair of boundaries that lie on each other.
struct CellBoundary {
  static constexpr dealii::types::boundary_id left = 0, right = 1, bottom = 2, top = 3, crack_lower = 4,
                                              crack_upper = 5;
};

/// Fills an empty triangulation with the unit cell. The nodes of the whole crack line, initial crack and
/// ligament, are there twice: once for the faces below, once for those above.
void make_cell_mesh(const GridLines& lines, dealii::Triangulation<2>& mesh);

} // namespace spall
