#pragma once

#include "micro/cell/boundary.h"
#include "micro/cell/mesh.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/lac/affine_constraints.h>

#include <array>
#include <vector>

namespace spall {

/// One opening of the cell: a place on a crack face, with its periodic images, and what moves when it opens.
/// Where k copies of a node meet (cracks that cross or branch), k interfaces or more lead round the place but
/// only k - 1 openings are independent: the first ones of the mesh's list, ligaments before initial cracks.
/// An interface that is left over there carries no law at that node; what it stands for goes to an interface
/// of its line at the same place, else to the nearest node of the same face. So no energy and no strength is
/// lost; but the load of the one left over passes through the others, which open earlier than they should,
/// the more so the shorter they are: an error of one node's share, O(h). In return every opening answers to
/// its own law, and where all of them hold all copies move as one.
template<int dim> struct CrackPair {
  dealii::Point<dim> position; ///< of the first image, unit cell
  double weight = 0;           ///< sum of the integrals of its shape function; over the ligament alone where
                               ///< it touches the ligament, as only that part can carry traction
  bool initially_open = false; ///< does not touch the ligament
  int line = 0;                ///< of cracks
  /// Of the crack, from the lower to the upper face; mean over the faces that give the weight.
  dealii::Tensor<1, dim> normal;
  /// Nodes, by the dof of each component, that move by a unit opening while the others stay: the upper face's
  /// copy of the node, those beyond it, and all their images.
  std::vector<std::array<dealii::types::global_dof_index, dim>> moved;
};

/// Pairs on the cracks, in the order of the seams. Under Boundary::linear_displacement none at the border:
/// it cannot open.
template<int dim>
std::vector<CrackPair<dim>> crack_pairs(const dealii::DoFHandler<dim>& dofs,
                                        const std::vector<Seam<dim>>& seams, Boundary boundary);

/// Fluctuations of the cell with closed cracks (equal on both crack faces) and no rigid motion. With openings
/// and macroscopic strain added on top this spans every displacement.
template<int dim>
dealii::AffineConstraints<double> closed_constraints(const dealii::DoFHandler<dim>& dofs,
                                                     const std::vector<Seam<dim>>& seams, Boundary boundary);

} // namespace spall
