#pragma once

#include "micro/cell/crack_lines.h"

#include <vector>

namespace spall {

/// Whether neighbouring elements share their nodes.
enum class ElementKind { continuous, discontinuous };
const std::vector<std::pair<std::string, ElementKind>>& element_words();

/// How the displacement is approximated.
struct Elements {
  Elements(unsigned int degree_ = 3, ElementKind kind_ = ElementKind::continuous, double penalty_ = 2)
      : degree(degree_), kind(kind_), penalty(penalty_) {}
  unsigned int degree;
  ElementKind kind;
  double penalty; ///< of discontinuous elements, see assemble_stiffness()
};

/// How finely the cell is meshed. The default comes from a measured study (data/microcells/README.md): every
/// mesh tried has the damage curve within 0.1 %, and this is the cheapest with the initial damage, which
/// carries the crack-tip singularity, within 0.001: 2236 unknowns, 84 on the crack line, 0.08 s, against
/// 0.11 s with quadratics and 0.50 s with linear elements.
struct MeshDensity {
  int elements = 4;   ///< over half the cell's height; other segments in proportion, see grid_lines()
  double grading = 3; ///< elements grow with distance from crack tip and crack line as s^grading; 1: uniform
  int degree = 3;     ///< of the displacement
  int layers = 1;     ///< elements along z where a cell of 3D is a plane one extruded
  ElementKind kind = ElementKind::continuous;
  double penalty = Elements{}.penalty;
  Elements approximation() const { return {static_cast<unsigned int>(degree), kind, penalty}; }
};

/// Mesh lines of the unit cell with a single centred crack: a tensor-product grid with lines at the crack
/// tips and on the crack line.
struct GridLines {
  std::vector<double> x, y; ///< ascending from 0 to 1
};

/// Positions s^grading from each tip into the crack and into the ligament, and from the crack line up and
/// down. A segment of length L gets elements * (2 L)^(1/grading) elements, so that the elements at a tip are
/// of one size on all sides.
GridLines grid_lines(const CellGeometry& geometry, const MeshDensity& density);

/// One row of vertices.
struct GridRow {
  std::vector<double> y; ///< at each x of the grid
  int line = -1;         ///< number of the crack line it lies on; -1: none
};

/// One column of vertices that lies on a vertical crack line.
struct GridColumn {
  std::size_t at = 0;     ///< index of its x
  int line = 0;           ///< number of the crack line
  std::vector<bool> open; ///< per interval of rows: initial crack
};

/// Mesh of any cell: columns of vertices at x, rows that follow the crack lines and blend between them. Its
/// left and right edges are vertical; the lower and upper edge rise by `rise`, and the right edge is the left
/// one shifted by it, periodic in height. Mesh lines crowd at tips and crack lines as grid_lines() does; a
/// single centred crack gets just those.
struct CellGrid {
  std::vector<double> x;               ///< ascending from 0 to 1
  std::vector<GridRow> rows;           ///< bottom to top
  std::vector<std::vector<bool>> open; ///< per crack line and interval of x: initial crack
  double rise = 0;
  std::vector<GridColumn> vertical{};
};
CellGrid cell_grid(const CellGeometry& geometry, const MeshDensity& density);

/// Longest element on a ligament, as a fraction of the cell's edge.
double coarsest_ligament_element(const CellGrid& grid);

} // namespace spall
