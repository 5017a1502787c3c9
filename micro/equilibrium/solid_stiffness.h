#pragma once

#include "micro/cell/geometry.h"
#include "micro/equilibrium/isotropic.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_system.h>

#include <Eigen/SparseCore>

#include <vector>

namespace spall {

template<int dim> dealii::FESystem<dim> displacement_element(const Elements& elements);

/// Assembles the stiffness matrix of a mesh without constraints on its boundary, crack faces included. With
/// discontinuous elements the faces between them carry the symmetric interior penalty form (Arnold 1982; for
/// elasticity Hansbo and Larson 2002): int -{s(u) n}.[v] - [u].{s(v) n} + penalty p (p + 1) (lambda + 2 mu) /
/// h [u].[v], h the harmonic mean of both elements' sizes across the face, times 1/2. It is not needed across
/// cracks and periodic boundaries, where constraints tie or open the facing nodes.
/// @param phases elasticity, indexed by material number
template<int dim>
Eigen::SparseMatrix<double> assemble_stiffness(const dealii::DoFHandler<dim>& dofs,
                                               const std::vector<Isotropic>& phases,
                                               const Elements& elements);

} // namespace spall
