#pragma once

#include "micro/cell/geometry.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/lac/affine_constraints.h>

#include <array>
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
  std::vector<FacingNodes> images{};
};

/// Pairs on the crack line, in the order of first appearance from the left.
std::vector<CrackPair> crack_pairs(const dealii::DoFHandler<2>& dofs, const CellGeometry& geometry);

/// Fluctuations of the cell: equal on opposite edges (periodic), equal on both crack faces (closed), zero at
/// one node (no translation). With openings and macroscopic strain added on top this spans every
/// displacement.
dealii::AffineConstraints<double> closed_periodic_constraints(const dealii::DoFHandler<2>& dofs);

} // namespace spall
