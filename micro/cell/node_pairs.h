#pragma once

#include "micro/cell/boundary.h"
#include "micro/cell/mesh.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/lac/affine_constraints.h>

#include <array>
#include <vector>

namespace spall {

/// One opening degree of freedom of the cell (a vector): a node on a crack face, with its periodic images,
/// and the nodes that move when it opens. Where k copies of a node meet (cracks that cross or branch), there
/// are k interfaces or more around the node but only k - 1 independent openings. The independent ones are the
/// first ones in the mesh's list, ligaments before initial cracks. A dependent interface has no cohesive law
/// at that node; its area is added to an interface of the same line at the same node, or else to the nearest
/// node of the same face. So no energy and no strength is lost. But the load of the dependent interface
/// passes through the others, which open earlier than they should, the more so the shorter they are: an error
/// of one node's area, O(h). In return every opening has its own law, and where all interfaces are closed all
/// copies move together.
template<int dim> struct CrackPair {
  dealii::Point<dim> position; ///< position of the first image in the unit cell
  double weight = 0; ///< integral of the node's shape function over the crack faces; where it touches a
                     ///< ligament over the ligament alone, as only that part can carry traction
  bool initially_open = false; ///< the node does not touch a ligament
  int line = 0;                ///< number of the crack line
  /// Unit normal of the crack, from the lower to the upper face; mean over the faces that contribute to the
  /// weight.
  dealii::Tensor<1, dim> normal;
  /// The nodes that a unit opening moves, each given by the dofs of its components: the upper face's copy of
  /// the node, the copies connected to it by other interfaces, and all their periodic images.
  std::vector<std::array<dealii::types::global_dof_index, dim>> moved;
};

/// Returns the crack pairs in the order of the seams. Under Boundary::linear_displacement there are none at
/// the border, which cannot open.
template<int dim>
std::vector<CrackPair<dim>> crack_pairs(const dealii::DoFHandler<dim>& dofs,
                                        const std::vector<Seam<dim>>& seams, Boundary boundary);

/// Returns the constraints of the displacement fluctuation in a cell with closed cracks (equal on both crack
/// faces) and without rigid body motion. The fluctuation, the openings and the macroscopic strain together
/// span every displacement.
template<int dim>
dealii::AffineConstraints<double> closed_constraints(const dealii::DoFHandler<dim>& dofs,
                                                     const std::vector<Seam<dim>>& seams, Boundary boundary);

} // namespace spall
