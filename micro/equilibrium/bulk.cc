#include "micro/equilibrium/bulk.h"

#include "micro/cell/mesh.h"
#include "micro/cell/node_pairs.h"
#include "micro/equilibrium/condense.h"
#include "micro/equilibrium/isotropic.h"
#include "micro/equilibrium/sparse_cholesky.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q1.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/sparse_matrix.h>

#include <Eigen/LU>

#include <array>

namespace spall {
namespace {

using dealii::Vector;
const dealii::FEValuesExtractors::Vector displacements(0);

/// Stiffness twice: of the free mesh, which gives forces, and of the fluctuations, which gets factorised.
struct Stiffness {
  dealii::SparsityPattern free_pattern, constrained_pattern;
  dealii::SparseMatrix<double> free, constrained;
};

void assemble(const dealii::DoFHandler<2>& dofs, const dealii::AffineConstraints<double>& constraints,
              const std::vector<Isotropic>& phases, Stiffness& stiffness) {
  const auto& element = dofs.get_fe();
  {
    dealii::DynamicSparsityPattern pattern(dofs.n_dofs());
    dealii::DoFTools::make_sparsity_pattern(dofs, pattern);
    stiffness.free_pattern.copy_from(pattern);
    stiffness.free.reinit(stiffness.free_pattern);
  }
  {
    dealii::DynamicSparsityPattern pattern(dofs.n_dofs());
    dealii::DoFTools::make_sparsity_pattern(dofs, pattern, constraints, false);
    stiffness.constrained_pattern.copy_from(pattern);
    stiffness.constrained.reinit(stiffness.constrained_pattern);
  }
  const dealii::QGauss<2> quadrature(element.degree + 1);
  dealii::FEValues<2> values(element, quadrature, dealii::update_gradients | dealii::update_JxW_values);
  const unsigned int n = element.n_dofs_per_cell();
  dealii::FullMatrix<double> local(n, n);
  std::vector<dealii::types::global_dof_index> indices(n);
  for (const auto& cell : dofs.active_cell_iterators()) {
    values.reinit(cell);
    const Isotropic& elastic = phases[cell->material_id()];
    local = 0;
    for (unsigned int q = 0; q < quadrature.size(); ++q)
      for (unsigned int i = 0; i < n; ++i) {
        const auto ei = values[displacements].symmetric_gradient(i, q);
        const double di = dealii::trace(ei);
        for (unsigned int j = 0; j < n; ++j) {
          const auto ej = values[displacements].symmetric_gradient(j, q);
          local(i, j) +=
              (elastic.lambda * di * dealii::trace(ej) + 2 * elastic.mu * (ei * ej)) * values.JxW(q);
        }
      }
    cell->get_dof_indices(indices);
    stiffness.free.add(indices, local);
    constraints.distribute_local_to_global(local, indices, stiffness.constrained);
  }
}

/// Unit vector normal to a pair's crack or along it (to the right).
dealii::Tensor<1, 2> direction(const CrackPair<2>& pair, bool normal) {
  return normal ? pair.normal : dealii::Tensor<1, 2>({pair.normal[1], -pair.normal[0]});
}

} // namespace

Bulk::Bulk(const CellGeometry& geometry, const MeshDensity& density, double poisson_ratio, Boundary boundary)
    : Bulk(cell_complex(cell_grid(geometry, density)), density.degree, 0, {Isotropic(poisson_ratio)},
           boundary) {}

Bulk::Bulk(const CellComplex<2>& complex, unsigned int degree, unsigned int refinements,
           std::vector<Isotropic> phases, Boundary boundary)
    : elastic(std::move(phases)), element(dealii::FE_Q<2>(degree), 2), handler(triangulation) {
  const auto seams = make_split_mesh(complex, refinements, triangulation);
  handler.distribute_dofs(element);
  const std::vector<CrackPair<2>> pairs = crack_pairs(handler, seams, boundary);
  const auto constraints = closed_constraints(handler, seams, boundary);
  Stiffness stiffness;
  assemble(handler, constraints, elastic, stiffness);
  SparseCholesky factor;
  factor.initialize(stiffness.constrained);

  // A prescribed jump or affine displacement, relaxed by the best fluctuation.
  const auto relax = [&](Vector<double>& mode) {
    Vector<double> force(handler.n_dofs());
    stiffness.free.vmult(force, mode);
    constraints.condense(force);
    factor.solve(force);
    constraints.distribute(force);
    mode -= force;
  };
  for (const CrackPair<2>& pair : pairs) {
    cell.nodes.push_back({.position = pair.position[0],
                          .weight = pair.weight,
                          .initially_open = pair.initially_open,
                          .line = pair.line});
    // The upper face moves against the lower one, along the normal or the tangent.
    for (const bool normal : {true, false}) {
      Vector<double> mode(handler.n_dofs());
      for (const auto& node : pair.moved)
        for (int c = 0; c < 2; ++c) mode[node[c]] = direction(pair, normal)[c];
      relax(mode);
      opening_modes.push_back(std::move(mode));
    }
  }
  std::vector<dealii::Point<2>> support(handler.n_dofs());
  dealii::DoFTools::map_dofs_to_support_points(dealii::MappingQ1<2>(), handler, support);
  const dealii::IndexSet vertical =
      dealii::DoFTools::extract_dofs(handler, element.component_mask(dealii::FEValuesExtractors::Scalar(1)));
  for (int component = 0; component < 3; ++component) {
    Vector<double> mode(handler.n_dofs());
    for (dealii::types::global_dof_index i = 0; i < handler.n_dofs(); ++i) {
      const bool y = vertical.is_element(i);
      if (component < 2)
        mode[i] = y == (component == 1) ? support[i][component] : 0;
      else
        mode[i] = 0.5 * support[i][y ? 0 : 1];
    }
    // Under uniform tractions relaxing would undo the strain itself; a closed uniform cell strains uniformly.
    if (boundary != Boundary::uniform_traction) relax(mode);
    strain_modes.push_back(std::move(mode));
  }

  // A relaxed mode's nodal forces vanish but where something is prescribed: on the upper face, summed over
  // the images, they are its reactions to the unit openings.
  const auto reactions = [&](const Vector<double>& mode) {
    Vector<double> force(handler.n_dofs());
    stiffness.free.vmult(force, mode);
    Eigen::VectorXd result(2 * pairs.size());
    for (std::size_t i = 0; i < pairs.size(); ++i)
      for (int c = 0; c < 2; ++c) {
        result[2 * i + c] = 0;
        const dealii::Tensor<1, 2> along = direction(pairs[i], c == 0);
        for (const auto& node : pairs[i].moved)
          result[2 * i + c] += along[1] * force[node[1]] + along[0] * force[node[0]];
      }
    return result;
  };
  const auto size = static_cast<Eigen::Index>(opening_modes.size());
  cell.stiffness.resize(size, size);
  cell.coupling.resize(size, 3);
  for (Eigen::Index j = 0; j < size; ++j) cell.stiffness.col(j) = reactions(opening_modes[j]);
  cell.stiffness = (0.5 * (cell.stiffness + cell.stiffness.transpose())).eval();
  for (int j = 0; j < 3; ++j) {
    // Opening relieves strain: the coupling is minus the mixed second derivative of the energy.
    cell.coupling.col(j) = -reactions(strain_modes[j]);
    for (int i = 0; i < 3; ++i)
      cell.uncracked(i, j) = stiffness.free.matrix_scalar_product(strain_modes[i], strain_modes[j]);
  }
  if (boundary != Boundary::uniform_traction) return;
  // So far the openings were relaxed at zero mean stress, where they strain the cell by C^-1 G^T w. At given
  // strain the mean stress answers: S = S_0 + G C^-1 G^T, by which each opening's mode strains back.
  const Eigen::Matrix3d compliance = cell.uncracked.inverse();
  const Eigen::MatrixXd strains = compliance * cell.coupling.transpose();
  cell.stiffness += cell.coupling * strains;
  for (Eigen::Index j = 0; j < size; ++j)
    for (int k = 0; k < 3; ++k) opening_modes[j].add(-strains(k, j), strain_modes[k]);
}

dealii::Vector<double> Bulk::displacement(const Eigen::VectorXd& w, const Voigt<2>& strain) const {
  Vector<double> u(handler.n_dofs());
  for (std::size_t i = 0; i < opening_modes.size(); ++i)
    if (w[i] != 0) u.add(w[i], opening_modes[i]);
  for (int i = 0; i < 3; ++i) u.add(strain[i], strain_modes[i]);
  return u;
}

template<class AtPoint> void Bulk::integrate(const Vector<double>& u, const AtPoint& at_point) const {
  const dealii::QGauss<2> quadrature(element.degree + 1);
  dealii::FEValues<2> values(element, quadrature, dealii::update_gradients | dealii::update_JxW_values);
  std::vector<dealii::SymmetricTensor<2, 2>> strain(quadrature.size());
  for (const auto& quad : handler.active_cell_iterators()) {
    values.reinit(quad);
    values[displacements].get_function_symmetric_gradients(u, strain);
    const Isotropic& phase = elastic[quad->material_id()];
    for (unsigned int q = 0; q < quadrature.size(); ++q)
      at_point(strain[q],
               phase.lambda * dealii::trace(strain[q]) * dealii::unit_symmetric_tensor<2>() +
                   2 * phase.mu * strain[q],
               values.JxW(q));
  }
}

double Bulk::elastic_energy(const Vector<double>& u) const {
  double energy = 0;
  integrate(u, [&energy](const auto& strain, const auto& stress, double volume) {
    energy += 0.5 * (stress * strain) * volume;
  });
  return energy;
}

Voigt<2> Bulk::average_stress(const Vector<double>& u) const {
  Voigt<2> average = Voigt<2>::Zero();
  integrate(u, [&average](const auto&, const auto& stress, double volume) {
    average += volume * Voigt<2>(stress[0][0], stress[1][1], stress[0][1]);
  });
  return average;
}

CondensedCell<2> condense(const CellGeometry& geometry, const MeshDensity& density, double poisson_ratio,
                          Boundary boundary) {
  return Bulk(geometry, density, poisson_ratio, boundary).condensed();
}

} // namespace spall
