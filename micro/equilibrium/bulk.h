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

#include <vector>

namespace spall {

/// The linear elastic bulk of the unit cell (area 1, plane strain, stresses in units of the Young's modulus
/// of reference, which is that of a uniform cell), solved once for each unit opening of its crack lines and
/// each unit macroscopic strain. The rest of the microcell works on the condensed form; the full displacement
/// is needed for fields only.
class Bulk {
public:
  /// Meshes, assembles, factorises once and condenses.
  /// @param poisson_ratio -1 < nu < 1/2
  Bulk(const CellGeometry& geometry, const MeshDensity& density, double poisson_ratio,
       Boundary boundary = Boundary::periodic);

  /// Any mesh, cracks and materials. A cell that is not uniform may not hang by uniform tractions.
  /// @param phases elasticity of each material number
  Bulk(const CellComplex<2>& complex, unsigned int degree, unsigned int refinements,
       std::vector<Isotropic> phases, Boundary boundary = Boundary::periodic);

  const CondensedCell<2>& condensed() const { return cell; }

  /// Nodal displacement of the unit cell for openings `w` (2n, in units of the edge) and macroscopic strain.
  dealii::Vector<double> displacement(const Eigen::VectorXd& w, const Voigt<2>& strain) const;

  /// (1/V) int sigma:e / 2 of a nodal displacement, in units of the modulus: Eq. 25 integrated on the mesh.
  double elastic_energy(const dealii::Vector<double>& displacement) const;

  /// Average stress over the mesh (Voigt) of a nodal displacement, in units of the modulus.
  Voigt<2> average_stress(const dealii::Vector<double>& displacement) const;

  const dealii::DoFHandler<2>& dofs() const { return handler; }
  const dealii::Triangulation<2>& mesh() const { return triangulation; }
  const std::vector<Isotropic>& phases() const { return elastic; }

private:
  template<class AtPoint> void integrate(const dealii::Vector<double>& u, const AtPoint& at_point) const;

  std::vector<Isotropic> elastic; ///< by material number
  dealii::Triangulation<2> triangulation;
  dealii::FESystem<2> element;
  dealii::DoFHandler<2> handler;
  CondensedCell<2> cell;
  std::vector<dealii::Vector<double>> opening_modes; ///< 2n: response to one unit opening
  std::vector<dealii::Vector<double>> strain_modes;  ///< 3: response to one unit strain, crack closed
};

} // namespace spall
