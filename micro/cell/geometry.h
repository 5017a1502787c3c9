#pragma once

#include <vector>

namespace spall {

/// The square cell of edge 1: one centred horizontal crack at mid-height whose ligament is cohesive over the
/// rest of the width. Everything linear is independent of the real edge l in 2D, so it enters only later.
struct CellGeometry {
  double crack_ratio = 0; ///< 2 a0 / l, 0 (no crack) to below 1
};

/// How finely the cell is meshed. The default comes from a measured study (data/microcells/README.md): every
/// mesh tried has the damage curve within 0.1 %, and this is the cheapest with the initial damage, which
/// carries the crack-tip singularity, within 0.001: 2236 unknowns, 84 on the crack line, 0.18 s, against
/// 0.27 s with quadratics and 1.35 s with linear elements.
struct MeshDensity {
  int elements = 4;   ///< over half the cell's height; other segments in proportion, see grid_lines()
  double grading = 3; ///< elements grow with distance from crack tip and crack line as s^grading; 1: uniform
  int degree = 3;     ///< of the displacement
};

/// Mesh lines of the unit cell: a tensor-product grid with lines at the crack tips and on the crack line.
struct GridLines {
  std::vector<double> x, y; ///< ascending from 0 to 1
};

/// Positions s^grading from each tip into the crack and into the ligament, and from the crack line up and
/// down. A segment of length L gets elements * (2 L)^(1/grading) elements, so that the elements at a tip are
/// of one size on all sides.
GridLines grid_lines(const CellGeometry& geometry, const MeshDensity& density);

/// Longest element on the ligament, as a fraction of the cell's edge.
double coarsest_ligament_element(const CellGeometry& geometry, const GridLines& lines);

} // namespace spall
