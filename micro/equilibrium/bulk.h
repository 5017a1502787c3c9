#pragma once

#include "micro/cell/boundary.h"
#include "micro/cell/geometry.h"
#include "micro/cell/mesh.h"
#include "micro/equilibrium/condensed_cell.h"
#include "micro/equilibrium/condensing_factor.h"
#include "micro/equilibrium/isotropic.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/vector.h>

#include <Eigen/SparseCore>

#include <memory>
#include <utility>
#include <vector>

namespace spall {

/// The linear elastic bulk of the unit cell (volume 1; plane strain in 2D; stresses in units of a reference
/// Young's modulus, which is that of a uniform cell). Its stiffness is factorised once and statically
/// condensed onto the openings of the cracks and the macroscopic strain (a Schur complement). The rest of the
/// microcell works on the condensed form; the full displacement is needed for fields only.
template<int dim> class Bulk {
public:
  /// Meshes, assembles, factorises once and condenses. Boundary::uniform_traction is for uniform cells only.
  /// @param phases elasticity, indexed by material number
  /// @throws ComputationError if the stiffness is not positive definite, for instance because the interior
  /// penalty is too small
  Bulk(const CellComplex<dim>& complex, const Elements& elements, unsigned int refinements,
       std::vector<Isotropic> phases, Boundary boundary = Boundary::periodic);

  /// Makes a uniform cell with the cracks of a geometry.
  /// @param poisson_ratio -1 < nu < 1/2
  Bulk(const CellGeometry& geometry, const MeshDensity& density, double poisson_ratio,
       Boundary boundary = Boundary::periodic)
      : Bulk(cell_complex<dim>(geometry, density), density.approximation(), 0, {Isotropic(poisson_ratio)},
             boundary) {}

  const CondensedCell<dim>& condensed() const { return cell; }

  /// Returns the nodal displacement of the unit cell for openings `w` (dim per node, in units of the edge)
  /// and macroscopic strain. It costs one forward and backward substitution.
  dealii::Vector<double> displacement(const Eigen::VectorXd& w, const Voigt<dim>& strain) const;

  /// Returns (1/V) int sigma:e / 2 of a nodal displacement, in units of the modulus: Eq. 25 integrated on the
  /// mesh.
  double elastic_energy(const dealii::Vector<double>& displacement) const;

  /// Returns the volume average of the stress of a nodal displacement, in units of the modulus.
  Voigt<dim> average_stress(const dealii::Vector<double>& displacement) const;

  const dealii::DoFHandler<dim>& dofs() const { return handler; }
  const dealii::Triangulation<dim>& mesh() const { return triangulation; }
  const std::vector<Isotropic>& phases() const { return elastic; }

private:
  template<class AtPoint> void integrate(const dealii::Vector<double>& u, const AtPoint& at_point) const;
  Eigen::MatrixXd affine() const;

  std::vector<Isotropic> elastic; ///< elasticity, indexed by material number
  dealii::Triangulation<dim> triangulation;
  dealii::FESystem<dim> element;
  dealii::DoFHandler<dim> handler;
  CondensedCell<dim> cell;
  Eigen::SparseMatrix<double> stiffness; ///< stiffness matrix of the mesh without any constraint
  /// Columns: displacement by each fluctuation degree of freedom, then by each opening.
  Eigen::SparseMatrix<double> modes;
  std::unique_ptr<const CondensingFactor> factor; ///< of the stiffness of the modes
  /// Mean strain by which a unit opening unloads the cell under uniform tractions; empty for other boundary
  /// conditions.
  Eigen::MatrixXd strain_of_opening;
};

} // namespace spall
