#pragma once

#include "micro/cell/boundary.h"
#include "micro/cell/geometry.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/lac/affine_constraints.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace spall {

/// Two nodes (dof of x and y each) that lie on each other across the crack line.
struct FacingNodes {
  std::array<dealii::types::global_dof_index, 2> lower, upper;
};

/// One opening unknown pair of the periodic cell: all its images (two on the cell's edge, else one).
struct CrackPair {
  double position = 0;         ///< x of the first image, unit cell
  double weight = 0;           ///< sum of the integrals of its shape function; over the ligament alone where
                               ///< it touches the ligament, as only that part can carry traction
  bool initially_open = false; ///< does not touch the ligament
  bool on_edge = false;        ///< on the cell's left or right edge
  int line = 0;                ///< crack line
  /// Of the crack, from the lower to the upper face; mean over the faces that give the weight.
  std::array<double, 2> normal{0, 1};
  std::vector<FacingNodes> images{};
};

/// Pairs on the crack lines, line by line, in the order of first appearance from the left.
/// @param periodic join the pairs on the left edge to those on the right
std::vector<CrackPair> crack_pairs(const dealii::DoFHandler<2>& dofs, const CellGrid& grid, bool periodic);

/// Fluctuations of the cell with closed cracks (equal on both crack faces) and no rigid motion. With openings
/// and macroscopic strain added on top this spans every displacement.
dealii::AffineConstraints<double> closed_constraints(const dealii::DoFHandler<2>& dofs, Boundary boundary,
                                                     unsigned int lines);

} // namespace spall
