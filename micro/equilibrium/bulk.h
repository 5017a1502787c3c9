#pragma once

#include "micro/cell/boundary.h"
#include "micro/cell/geometry.h"
#include "micro/cell/mesh.h"
#include "micro/equilibrium/condensed_cell.h"
#include "micro/equilibrium/isotropic.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/vector.h>

#include <Eigen/SparseCore>

#include <utility>
#include <vector>

namespace spall {

/// The linear elastic bulk of the unit cell (volume 1; plane strain in 2D; stresses in units of the Young's
/// modulus of reference, which is that of a uniform cell), factorised once and condensed onto the openings of
/// its cracks and the macroscopic strain. The rest of the microcell works on the condensed form; the full
/// displacement is needed for fields only.
template<int dim> class Bulk {
public:
  /// Meshes, assembles, factorises once and condenses. Boundary::uniform_traction is for uniform cells only.
  /// @param phases elasticity of each material number
  /// @throws ComputationError if the stiffness is not positive definite: a penalty that is too small
  Bulk(const CellComplex<dim>& complex, const Elements& elements, unsigned int refinements,
       std::vector<Isotropic> phases, Boundary boundary = Boundary::periodic);

  /// A uniform cell with the cracks of a geometry.
  /// @param poisson_ratio -1 < nu < 1/2
  Bulk(const CellGeometry& geometry, const MeshDensity& density, double poisson_ratio,
       Boundary boundary = Boundary::periodic)
      : Bulk(cell_complex<dim>(geometry, density), density.approximation(), 0, {Isotropic(poisson_ratio)},
             boundary) {}

  const CondensedCell<dim>& condensed() const { return cell; }

  /// Nodal displacement of the unit cell for openings `w` (dim per node, in units of the edge) and
  /// macroscopic strain. Costs a solve with the factor.
  dealii::Vector<double> displacement(const Eigen::VectorXd& w, const Voigt<dim>& strain) const;

  /// (1/V) int sigma:e / 2 of a nodal displacement, in units of the modulus: Eq. 25 integrated on the mesh.
  double elastic_energy(const dealii::Vector<double>& displacement) const;

  /// Average stress over the mesh of a nodal displacement, in units of the modulus.
  Voigt<dim> average_stress(const dealii::Vector<double>& displacement) const;

  const dealii::DoFHandler<dim>& dofs() const { return handler; }
  const dealii::Triangulation<dim>& mesh() const { return triangulation; }
  const std::vector<Isotropic>& phases() const { return elastic; }

private:
  template<class AtPoint> void integrate(const dealii::Vector<double>& u, const AtPoint& at_point) const;
  Eigen::MatrixXd affine() const;

  std::vector<Isotropic> elastic; ///< by material number
  dealii::Triangulation<dim> triangulation;
  dealii::FESystem<dim> element;
  dealii::DoFHandler<dim> handler;
  CondensedCell<dim> cell;
  Eigen::SparseMatrix<double> stiffness; ///< of the free mesh
  Eigen::SparseMatrix<double> movements; ///< columns: displacement by each fluctuation, then by each opening
  Eigen::SparseMatrix<double> factor;    ///< lower Cholesky factor of the fluctuations
  Eigen::MatrixXd yielding; ///< strain by which an opening relaxes the cell under uniform tractions; or empty
};

} // namespace spall
