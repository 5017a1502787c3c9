#pragma once

#include "micro/cell/crack_lines.h"

#include <vector>

namespace spall {

/// Whether neighbouring elements share their nodes.
enum class ElementKind { continuous, discontinuous };
const std::vector<std::pair<std::string, ElementKind>>& element_words();

/// The finite element approximation of the displacement.
struct Elements {
  Elements(unsigned int degree_ = 3, ElementKind kind_ = ElementKind::continuous, double penalty_ = 2)
      : degree(degree_), kind(kind_), penalty(penalty_) {}
  unsigned int degree;
  ElementKind kind;
  double penalty; ///< interior penalty factor of discontinuous elements, see assemble_stiffness()
};

/// The density of the cell's mesh. The defaults come from a measured study (data/microcells/README.md): every
/// mesh tried gives the damage curve within 0.1 %. The default is the cheapest mesh whose initial damage,
/// which depends on the crack-tip singularity, is within 0.001. It has 2236 unknowns, 84 of them on the crack
/// line, and takes 0.08 s; quadratic elements take 0.11 s and linear ones 0.50 s.
struct MeshDensity {
  int elements = 4;   ///< number of elements over half the cell's height; other segments get a number in
                      ///< proportion, see grid_lines()
  double grading = 3; ///< exponent of the element size: the distance of mesh lines from crack tip and crack
                      ///< line grows as s^grading; 1: uniform mesh
  int degree = 3;     ///< polynomial degree of the displacement
  int layers = 1;     ///< number of elements along z in a 3D cell that is an extruded plane cell
  ElementKind kind = ElementKind::continuous;
  double penalty = Elements{}.penalty;
  Elements approximation() const { return {static_cast<unsigned int>(degree), kind, penalty}; }
};

/// Mesh lines of the unit cell with a single centred crack: a tensor-product grid with lines at the crack
/// tips and on the crack line.
struct GridLines {
  std::vector<double> x, y; ///< ascending from 0 to 1
};

/// Places the mesh lines at distances s^grading from each tip into the crack and into the ligament, and from
/// the crack line upwards and downwards. A segment of length L gets elements * (2 L)^(1/grading) elements, so
/// that the elements at a tip have the same size on all sides.
GridLines grid_lines(const CellGeometry& geometry, const MeshDensity& density);

/// One row of mesh vertices from the left to the right edge.
struct GridRow {
  std::vector<double> y; ///< height of the row at each x of the grid
  int line = -1;         ///< number of the crack line that the row lies on; -1: none
};

/// One column of vertices that lies on a vertical crack line.
struct GridColumn {
  std::size_t at = 0;     ///< index of the column among the x of the grid
  int line = 0;           ///< number of the vertical crack line
  std::vector<bool> open; ///< for each interval between rows: whether it is an initial crack
};

/// The structured mesh of a plane cell: columns of vertices at x, and rows that follow the crack lines and
/// are interpolated between them. The left and right edges are vertical. The lower and upper edges rise by
/// `rise`, and the right edge is the left one shifted up by it, which is periodic in height. Mesh lines are
/// graded towards tips and crack lines as in grid_lines(); for a single centred crack they are those of
/// grid_lines().
struct CellGrid {
  std::vector<double> x;     ///< x of the columns, ascending from 0 to 1
  std::vector<GridRow> rows; ///< rows from the bottom to the top
  /// For each crack line and interval of x: whether it is an initial crack.
  std::vector<std::vector<bool>> open;
  double rise = 0; ///< rise of the lower and upper edge over the width
  std::vector<GridColumn> vertical{};
};
CellGrid cell_grid(const CellGeometry& geometry, const MeshDensity& density);

/// Length of the longest element on a ligament, as a fraction of the cell's edge.
double coarsest_ligament_element(const CellGrid& grid);

} // namespace spall
