#include "micro/equilibrium/solid_stiffness.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_dgq.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>

#include <Eigen/Core>

namespace spall {
namespace {

const dealii::FEValuesExtractors::Vector displacements(0);
using Entries = std::vector<Eigen::Triplet<double>>;
using Dofs = std::vector<dealii::types::global_dof_index>;

void add(const Dofs& indices, const Eigen::MatrixXd& local, Entries& entries) {
  for (std::size_t i = 0; i < indices.size(); ++i)
    for (std::size_t j = 0; j < indices.size(); ++j)
      entries.emplace_back(static_cast<int>(indices[i]), static_cast<int>(indices[j]), local(i, j));
}

/// Adds the penalty, symmetry and consistency terms on the faces between discontinuous elements.
template<int dim>
void add_faces(const dealii::DoFHandler<dim>& dofs, const std::vector<Isotropic>& phases, double penalty,
               Entries& entries) {
  const auto& element = dofs.get_fe();
  const unsigned int n = element.n_dofs_per_cell(), p = element.degree;
  const dealii::QGauss<dim - 1> quadrature(p + 1);
  const auto flags = dealii::update_values | dealii::update_gradients | dealii::update_JxW_values |
                     dealii::update_normal_vectors;
  dealii::FEFaceValues<dim> here(element, quadrature, flags), there(element, quadrature, flags);
  Dofs indices(2 * n), of_one(n);
  std::vector<dealii::Tensor<1, dim>> jump(2 * n), mean(2 * n);
  Eigen::MatrixXd local(2 * n, 2 * n);
  for (const auto& solid : dofs.active_cell_iterators())
    for (const unsigned int f : solid->face_indices()) {
      if (solid->at_boundary(f) || !(solid->active_cell_index() < solid->neighbor(f)->active_cell_index()))
        continue;
      const auto neighbor = solid->neighbor(f);
      here.reinit(solid, f);
      there.reinit(neighbor, solid->neighbor_of_neighbor(f));
      const double area = solid->face(f)->measure();
      const auto rigidity = [&](const auto& side) { // (lambda + 2 mu) / h
        const Isotropic& phase = phases[side->material_id()];
        return (phase.lambda + 2 * phase.mu) * area / side->measure();
      };
      const double stiff = penalty * p * (p + 1) * 0.5 * (rigidity(solid) + rigidity(neighbor));
      for (int side = 0; side < 2; ++side) {
        if (side == 0)
          solid->get_dof_indices(of_one);
        else
          neighbor->get_dof_indices(of_one);
        std::copy(of_one.begin(), of_one.end(), indices.begin() + side * n);
      }
      local.setZero();
      for (unsigned int q = 0; q < quadrature.size(); ++q) {
        const auto& normal = here.normal_vector(q);
        for (unsigned int i = 0; i < n; ++i) {
          jump[i] = here[displacements].value(i, q);
          jump[n + i] = -there[displacements].value(i, q);
          mean[i] = 0.5 * (phases[solid->material_id()].stress(here[displacements].symmetric_gradient(i, q)) *
                           normal);
          mean[n + i] =
              0.5 * (phases[neighbor->material_id()].stress(there[displacements].symmetric_gradient(i, q)) *
                     normal);
        }
        for (unsigned int i = 0; i < 2 * n; ++i)
          for (unsigned int j = 0; j < 2 * n; ++j)
            local(i, j) +=
                (stiff * (jump[i] * jump[j]) - mean[i] * jump[j] - jump[i] * mean[j]) * here.JxW(q);
      }
      add(indices, local, entries);
    }
}

} // namespace

template<int dim> dealii::FESystem<dim> displacement_element(const Elements& elements) {
  if (elements.kind == ElementKind::discontinuous)
    return dealii::FESystem<dim>(dealii::FE_DGQ<dim>(elements.degree), dim);
  return dealii::FESystem<dim>(dealii::FE_Q<dim>(elements.degree), dim);
}

template<int dim>
Eigen::SparseMatrix<double> assemble_stiffness(const dealii::DoFHandler<dim>& dofs,
                                               const std::vector<Isotropic>& phases,
                                               const Elements& elements) {
  const auto& element = dofs.get_fe();
  const dealii::QGauss<dim> quadrature(element.degree + 1);
  dealii::FEValues<dim> values(element, quadrature, dealii::update_gradients | dealii::update_JxW_values);
  const unsigned int n = element.n_dofs_per_cell();
  Eigen::MatrixXd local(n, n);
  Dofs indices(n);
  Entries entries;
  entries.reserve(static_cast<std::size_t>(dofs.get_triangulation().n_active_cells()) * n * n);
  std::vector<dealii::SymmetricTensor<2, dim>> strain(n), stress(n);
  for (const auto& solid : dofs.active_cell_iterators()) {
    values.reinit(solid);
    const Isotropic& phase = phases[solid->material_id()];
    local.setZero();
    for (unsigned int q = 0; q < quadrature.size(); ++q) {
      for (unsigned int i = 0; i < n; ++i) {
        strain[i] = values[displacements].symmetric_gradient(i, q);
        stress[i] = phase.stress(strain[i]) * values.JxW(q);
      }
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j) local(i, j) += stress[i] * strain[j];
    }
    solid->get_dof_indices(indices);
    add(indices, local, entries);
  }
  if (elements.kind == ElementKind::discontinuous) add_faces(dofs, phases, elements.penalty, entries);
  const auto size = static_cast<Eigen::Index>(dofs.n_dofs());
  Eigen::SparseMatrix<double> stiffness(size, size);
  stiffness.setFromTriplets(entries.begin(), entries.end());
  return stiffness;
}

#define SPALL_INSTANTIATE(dim)                                                                               \
  template dealii::FESystem<dim> displacement_element(const Elements&);                                      \
  template Eigen::SparseMatrix<double> assemble_stiffness(const dealii::DoFHandler<dim>&,                    \
                                                          const std::vector<Isotropic>&, const Elements&);
SPALL_INSTANTIATE(2)
SPALL_INSTANTIATE(3)
#undef SPALL_INSTANTIATE

} // namespace spall
