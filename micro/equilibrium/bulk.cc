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
#include <Eigen/OrderingMethods>
#include <Eigen/SparseCholesky>

#include <algorithm>

#include <array>

namespace spall {
namespace {

using dealii::Vector;
const dealii::FEValuesExtractors::Vector displacements(0);

/// Unit vectors normal to a pair's crack and along it: in 2D to the right, in 3D towards x (or z, if that is
/// nearer the normal) and across.
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

/// Place of each dof's fluctuation in an elimination that fills little (approximate minimum degree); -1 where
/// it is held. Dofs that are one and the same share their place.
std::vector<Eigen::Index> elimination_order(const Eigen::SparseMatrix<double>& stiffness,
                                            const dealii::AffineConstraints<double>& constraints) {
  std::vector<Eigen::Index> order(stiffness.rows(), -1);
  Eigen::Index count = 0;
  for (Eigen::Index i = 0; i < stiffness.rows(); ++i)
    if (!constraints.is_constrained(i)) order[i] = count++;
  for (Eigen::Index i = 0; i < stiffness.rows(); ++i)
    if (constraints.is_constrained(i))
      if (const auto* same = constraints.get_constraint_entries(i); !same->empty())
        order[i] = order[same->front().first];
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index column = 0; column < stiffness.outerSize(); ++column)
    for (Eigen::SparseMatrix<double>::InnerIterator entry(stiffness, column); entry; ++entry)
      if (order[entry.row()] >= 0 && order[column] >= 0)
        entries.emplace_back(order[entry.row()], order[column], 1.0);
  Eigen::SparseMatrix<double> neighbours(count, count);
  neighbours.setFromTriplets(entries.begin(), entries.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> sequence;
  Eigen::AMDOrdering<int>()(neighbours, sequence);
  const auto places = Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int>(sequence.inverse());
  for (Eigen::Index& place : order)
    if (place >= 0) place = places.indices()[place];
  return order;
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
  const std::vector<Eigen::Index> order = elimination_order(stiffness, constraints);

  // Displacement by the fluctuations, in the order of elimination, and by the openings.
  const auto dofs = static_cast<Eigen::Index>(handler.n_dofs());
  Eigen::Index fluctuations = 0, openings = 0;
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index i = 0; i < dofs; ++i) {
    fluctuations = std::max(fluctuations, order[i] + 1);
    if (order[i] >= 0) entries.emplace_back(i, order[i], 1.0);
  }
  for (const CrackPair<dim>& pair : crack_pairs(handler, seams, boundary)) {
    CrackNode node{.weight = pair.weight, .initially_open = pair.initially_open, .line = pair.line};
    for (int c = 0; c < dim; ++c) node.position[c] = pair.position[c];
    cell.nodes.push_back(node);
    for (const auto& along : frame<dim>(pair.normal)) {
      for (const auto& moved : pair.moved)
        for (int c = 0; c < dim; ++c)
          if (along[c] != 0) entries.emplace_back(moved[c], fluctuations + openings, along[c]);
      ++openings;
    }
  }
  movements.resize(dofs, fluctuations + openings);
  movements.setFromTriplets(entries.begin(), entries.end());

  // The factor's last columns, those of the openings, are the factor of what is left of the stiffness when
  // the fluctuations are eliminated: S = L22 L22^T. Where cracks cut the cell into blocks that move without a
  // force S is only semidefinite, so it is factorised with its own diagonal added.
  const Eigen::SparseMatrix<double> forces = stiffness * movements;
  Eigen::SparseMatrix<double> lower;
  Eigen::VectorXd added;
  {
    Eigen::SparseMatrix<double> all = movements.transpose() * forces;
    added = all.diagonal().tail(openings);
    for (Eigen::Index i = 0; i < openings; ++i) all.coeffRef(fluctuations + i, fluctuations + i) += added[i];
    const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>, Eigen::Lower, Eigen::NaturalOrdering<int>> llt(
        all);
    if (llt.info() != Eigen::Success)
      throw ComputationError("the stiffness of the solid is not positive definite" +
                             std::string(elements.kind == ElementKind::discontinuous
                                             ? ": Mesh/Penalty is too small for the discontinuous elements"
                                             : ""));
    lower = llt.matrixL();
  }
  const Eigen::MatrixXd last = lower.bottomRightCorner(openings, openings);
  cell.stiffness = last.template triangularView<Eigen::Lower>() * last.transpose();
  cell.stiffness.diagonal() -= added;
  const Eigen::SparseMatrix<double> across = lower.bottomLeftCorner(openings, fluctuations);
  factor = lower.topLeftCorner(fluctuations, fluctuations);

  // Opening relieves strain: the coupling is minus the mixed second derivative of the energy.
  const Eigen::MatrixXd strains = affine(), pull = forces.transpose() * strains;
  cell.coupling = -pull.bottomRows(openings);
  cell.uncracked = strains.transpose() * (stiffness * strains);
  if (boundary != Boundary::uniform_traction) {
    const Eigen::MatrixXd relaxed =
        factor.template triangularView<Eigen::Lower>().solve(pull.topRows(fluctuations));
    cell.coupling += across * relaxed;
    cell.uncracked -= relaxed.transpose() * relaxed;
    return;
  }
  // Relaxing a strain would undo it here; a closed uniform cell strains uniformly. So far the openings were
  // relaxed at zero mean stress, where they strain the cell by C^-1 G^T w. At given strain the mean stress
  // answers: S = S_0 + G C^-1 G^T, by which each opening strains back.
  yielding = cell.uncracked.inverse() * cell.coupling.transpose();
  cell.stiffness += cell.coupling * yielding;
}

/// Displacements (columns) whose strains are unit ones everywhere.
template<int dim> Eigen::MatrixXd Bulk<dim>::affine() const {
  std::vector<dealii::Point<dim>> support(handler.n_dofs());
  dealii::DoFTools::map_dofs_to_support_points(dealii::MappingQ1<dim>(), handler, support);
  Eigen::MatrixXd modes = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(handler.n_dofs()), voigt_size<dim>);
  for (int c = 0; c < dim; ++c)
    for (const auto i : dealii::DoFTools::extract_dofs(
             handler, element.component_mask(dealii::FEValuesExtractors::Scalar(c))))
      for (int k = 0; k < voigt_size<dim>; ++k) {
        const auto [row, column] = tensor_index<dim>(k);
        const double share = row == column ? 1 : 0.5;
        if (c == row)
          modes(i, k) = share * support[i][column];
        else if (c == column)
          modes(i, k) = share * support[i][row];
      }
  return modes;
}

template<int dim>
Vector<double> Bulk<dim>::displacement(const Eigen::VectorXd& w, const Voigt<dim>& strain) const {
  const Eigen::Index fluctuations = factor.rows();
  Eigen::VectorXd prescribed = movements.rightCols(w.size()) * w, macroscopic = affine() * strain;
  const bool yields = yielding.size() > 0;
  if (yields) macroscopic -= affine() * (yielding * w);
  const Eigen::VectorXd relaxed = yields ? prescribed : Eigen::VectorXd(prescribed + macroscopic);
  const Eigen::VectorXd load = movements.leftCols(fluctuations).transpose() * (stiffness * relaxed);
  Eigen::VectorXd answer = factor.template triangularView<Eigen::Lower>().solve(load);
  answer = factor.transpose().template triangularView<Eigen::Upper>().solve(answer).eval();
  const Eigen::VectorXd total = prescribed + macroscopic - movements.leftCols(fluctuations) * answer;
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
