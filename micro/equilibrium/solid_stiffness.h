#pragma once

#include "micro/cell/geometry.h"
#include "micro/equilibrium/isotropic.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_system.h>

#include <Eigen/SparseCore>

#include <vector>

namespace spall {

template<int dim> dealii::FESystem<dim> displacement_element(const Elements& elements);

/// Stiffness of a mesh on whose boundary, cracks included, nothing is prescribed. With discontinuous elements
/// the faces between them carry the symmetric interior penalty form (Arnold 1982; for elasticity Hansbo and
/// Larson 2002): int -{s(u) n}.[v] - [u].{s(v) n} + penalty p (p + 1) (lambda + 2 mu) / h [u].[v], h the
/// harmonic mean of both elements' sizes across the face, times 1/2. Across cracks and periods, where facing
/// nodes are tied or opened by constraints, it is not needed.
/// @param phases elasticity of each material number
template<int dim>
Eigen::SparseMatrix<double> assemble_stiffness(const dealii::DoFHandler<dim>& dofs,
                                               const std::vector<Isotropic>& phases,
                                               const Elements& elements);

} // namespace spall
