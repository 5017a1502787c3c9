#include "micro/equilibrium/bulk.h"

#include "micro/cell/node_pairs.h"
#include "micro/equilibrium/condense.h"
#include "micro/equilibrium/solid_stiffness.h"
#include "shared/error.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q1.h>

#include <Eigen/LU>

#include <algorithm>

#include <array>

namespace spall {
namespace {

using dealii::Vector;
const dealii::FEValuesExtractors::Vector displacements(0);

/// Returns the unit normal of a pair's crack and unit tangents: in 2D the one to the right, in 3D the
/// projection of x onto the crack (of z if x is close to the normal) and the vector normal to both.
template<int dim> std::array<dealii::Tensor<1, dim>, dim> frame(const dealii::Tensor<1, dim>& normal) {
  if constexpr (dim == 2) {
    return {normal, dealii::Tensor<1, 2>({normal[1], -normal[0]})};
  } else {
    dealii::Tensor<1, 3> along;
    along[std::abs(normal[0]) < 0.8 ? 0 : 2] = 1;
    along -= (along * normal) * normal;
    along /= along.norm();
    return {normal, along, dealii::cross_product_3d(along, normal)};
  }
}

/// Returns for each dof the number of the fluctuation that moves it; -1 for dofs that are held. Dofs that are
/// constrained to be equal share their fluctuation.
std::vector<Eigen::Index> fluctuation_numbers(std::size_t dofs,
                                              const dealii::AffineConstraints<double>& constraints) {
  std::vector<Eigen::Index> number(dofs, -1);
  Eigen::Index count = 0;
  for (std::size_t i = 0; i < dofs; ++i)
    if (!constraints.is_constrained(i)) number[i] = count++;
  for (std::size_t i = 0; i < dofs; ++i)
    if (constraints.is_constrained(i))
      if (const auto* same = constraints.get_constraint_entries(i); !same->empty())
        number[i] = number[same->front().first];
  return number;
}

/// Returns the displacement modes of the cell as columns: first those of the fluctuations, then those of
/// the openings, dim per pair.
template<int dim>
Eigen::SparseMatrix<double> displacement_modes(const std::vector<Eigen::Index>& number,
                                               const std::vector<CrackPair<dim>>& pairs) {
  const auto dofs = static_cast<Eigen::Index>(number.size());
  Eigen::Index fluctuations = 0, openings = 0;
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index i = 0; i < dofs; ++i) {
    fluctuations = std::max(fluctuations, number[i] + 1);
    if (number[i] >= 0) entries.emplace_back(i, number[i], 1.0);
  }
  for (const CrackPair<dim>& pair : pairs)
    for (const auto& along : frame<dim>(pair.normal)) {
      for (const auto& moved : pair.moved)
        for (int c = 0; c < dim; ++c)
          if (along[c] != 0) entries.emplace_back(moved[c], fluctuations + openings, along[c]);
      ++openings;
    }
  Eigen::SparseMatrix<double> modes(dofs, fluctuations + openings);
  modes.setFromTriplets(entries.begin(), entries.end());
  return modes;
}

} // namespace

template<int dim>
Bulk<dim>::Bulk(const CellComplex<dim>& complex, const Elements& elements, unsigned int refinements,
                std::vector<Isotropic> phases, Boundary boundary)
    : elastic(std::move(phases)), element(displacement_element<dim>(elements)), handler(triangulation) {
  const auto seams = make_split_mesh(complex, refinements, triangulation);
  handler.distribute_dofs(element);
  stiffness = assemble_stiffness(handler, elastic, elements);
  const auto constraints = closed_constraints(handler, seams, boundary);
  const std::vector<CrackPair<dim>> pairs = crack_pairs(handler, seams, boundary);
  for (const CrackPair<dim>& pair : pairs) {
    CrackNode node{.weight = pair.weight, .initially_open = pair.initially_open, .line = pair.line};
    for (int c = 0; c < dim; ++c) node.position[c] = pair.position[c];
    cell.nodes.push_back(node);
  }
  modes = displacement_modes<dim>(fluctuation_numbers(handler.n_dofs(), constraints), pairs);
  const auto openings = static_cast<Eigen::Index>(dim * pairs.size()), fluctuations = modes.cols() - openings;

  const Eigen::SparseMatrix<double> forces = stiffness * modes, all = modes.transpose() * forces;
  factor = std::make_unique<CondensingFactor>(all, openings);
  if (!factor->positive_definite())
    throw ComputationError("the stiffness of the solid is not positive definite" +
                           std::string(elements.kind == ElementKind::discontinuous
                                           ? ": Mesh/Penalty is too small for the discontinuous elements"
                                           : ""));
  cell.stiffness = factor->schur_complement();

  // An opening unloads the bulk: the coupling is minus the mixed second derivative of the energy.
  const Eigen::MatrixXd strains = affine(), pull = forces.transpose() * strains;
  cell.coupling = -pull.bottomRows(openings);
  cell.uncracked = strains.transpose() * (stiffness * strains);
  if (boundary != Boundary::uniform_traction) {
    const Eigen::MatrixXd relaxed = factor->solve(pull.topRows(fluctuations));
    cell.coupling += all.bottomLeftCorner(openings, fluctuations) * relaxed;
    cell.uncracked -= pull.topRows(fluctuations).transpose() * relaxed;
    return;
  }
  // Under uniform tractions the fluctuations include uniform strains, and a uniform cell with closed cracks
  // strains uniformly, so coupling and C need no correction. The Schur complement S_0 holds at zero mean
  // stress, at which the openings strain the cell by C^-1 G^T w. At given strain this part is reversed: S =
  // S_0 + G C^-1 G^T.
  strain_of_opening = cell.uncracked.inverse() * cell.coupling.transpose();
  cell.stiffness += cell.coupling * strain_of_opening;
}

/// Returns the nodal displacements (columns) of uniform unit strains.
template<int dim> Eigen::MatrixXd Bulk<dim>::affine() const {
  std::vector<dealii::Point<dim>> support(handler.n_dofs());
  dealii::DoFTools::map_dofs_to_support_points(dealii::MappingQ1<dim>(), handler, support);
  Eigen::MatrixXd nodal = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(handler.n_dofs()), voigt_size<dim>);
  for (int c = 0; c < dim; ++c)
    for (const auto i : dealii::DoFTools::extract_dofs(
             handler, element.component_mask(dealii::FEValuesExtractors::Scalar(c))))
      for (int k = 0; k < voigt_size<dim>; ++k) {
        const auto [row, column] = tensor_index<dim>(k);
        const double share = row == column ? 1 : 0.5;
        if (c == row)
          nodal(i, k) = share * support[i][column];
        else if (c == column)
          nodal(i, k) = share * support[i][row];
      }
  return nodal;
}

template<int dim>
Vector<double> Bulk<dim>::displacement(const Eigen::VectorXd& w, const Voigt<dim>& strain) const {
  const Eigen::Index fluctuations = modes.cols() - w.size();
  Eigen::VectorXd prescribed = modes.rightCols(w.size()) * w, macroscopic = affine() * strain;
  const bool uniform_traction = strain_of_opening.size() > 0;
  if (uniform_traction) macroscopic -= affine() * (strain_of_opening * w);
  const Eigen::VectorXd driving = uniform_traction ? prescribed : Eigen::VectorXd(prescribed + macroscopic);
  const Eigen::VectorXd load = modes.leftCols(fluctuations).transpose() * (stiffness * driving);
  const Eigen::VectorXd fluctuation = factor->solve(load);
  const Eigen::VectorXd total = prescribed + macroscopic - modes.leftCols(fluctuations) * fluctuation;
  return Vector<double>(total.begin(), total.end());
}

template<int dim>
template<class AtPoint>
void Bulk<dim>::integrate(const Vector<double>& u, const AtPoint& at_point) const {
  const dealii::QGauss<dim> quadrature(element.degree + 1);
  dealii::FEValues<dim> values(element, quadrature, dealii::update_gradients | dealii::update_JxW_values);
  std::vector<dealii::SymmetricTensor<2, dim>> strain(quadrature.size());
  for (const auto& solid : handler.active_cell_iterators()) {
    values.reinit(solid);
    values[displacements].get_function_symmetric_gradients(u, strain);
    const Isotropic& phase = elastic[solid->material_id()];
    for (unsigned int q = 0; q < quadrature.size(); ++q)
      at_point(strain[q], phase.stress(strain[q]), values.JxW(q));
  }
}

template<int dim> double Bulk<dim>::elastic_energy(const Vector<double>& u) const {
  double energy = 0;
  integrate(u, [&energy](const auto& strain, const auto& stress, double volume) {
    energy += 0.5 * (stress * strain) * volume;
  });
  return energy;
}

template<int dim> Voigt<dim> Bulk<dim>::average_stress(const Vector<double>& u) const {
  Voigt<dim> average = Voigt<dim>::Zero();
  integrate(u, [&average](const auto&, const auto& stress, double volume) {
    for (int i = 0; i < voigt_size<dim>; ++i) {
      const auto [row, column] = tensor_index<dim>(i);
      average[i] += volume * stress[row][column];
    }
  });
  return average;
}

template class Bulk<2>;
template class Bulk<3>;

template<int dim>
CondensedCell<dim> condense(const CellGeometry& geometry, const MeshDensity& density, double poisson_ratio,
                            Boundary boundary) {
  return Bulk<dim>(geometry, density, poisson_ratio, boundary).condensed();
}
template CondensedCell<2> condense(const CellGeometry&, const MeshDensity&, double, Boundary);
template CondensedCell<3> condense(const CellGeometry&, const MeshDensity&, double, Boundary);

} // namespace spall
