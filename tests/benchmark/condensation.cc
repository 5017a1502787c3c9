// Condensation of a solid's stiffness: the supernodal factor with its own order of elimination against the
// factor column by column with minimum degree (Eigen). Compare the two results of a size: their ratio is what
// one gains.
//
//   build/tests/benchmark/benchmark_micro
// Arguments: dimensions, elements along an edge (quadratic).

#include "micro/equilibrium/condensing_factor.h"
#include "micro/equilibrium/solid_stiffness.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCholesky>

#include <benchmark/benchmark.h>

namespace spall {
namespace {

/// Returns the stiffness of a uniform square or cube on weak ground; the last twentieth of the unknowns,
/// which are of one corner, is kept.
template<int dim> Eigen::SparseMatrix<double> block(unsigned int elements) {
  const Elements approximation{2};
  dealii::Triangulation<dim> mesh;
  dealii::GridGenerator::subdivided_hyper_cube(mesh, elements);
  const dealii::FESystem<dim> element = displacement_element<dim>(approximation);
  dealii::DoFHandler<dim> dofs(mesh);
  dofs.distribute_dofs(element);
  Eigen::SparseMatrix<double> matrix = assemble_stiffness(dofs, {Isotropic(0.2)}, approximation);
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) matrix.coeffRef(i, i) *= 1.01;
  return matrix;
}
Eigen::SparseMatrix<double> block(const benchmark::State& state) {
  const auto elements = static_cast<unsigned int>(state.range(1));
  return state.range(0) == 2 ? block<2>(elements) : block<3>(elements);
}

void sizes(benchmark::internal::Benchmark* b) {
  b->ArgNames({"dim", "elements"})->Unit(benchmark::kMillisecond);
  for (const int elements : {12, 48}) b->Args({2, elements});
  for (const int elements : {5, 8}) b->Args({3, elements});
}

void Supernodal(benchmark::State& state) {
  const Eigen::SparseMatrix<double> matrix = block(state);
  for (auto _ : state)
    benchmark::DoNotOptimize(CondensingFactor(matrix, matrix.rows() / 20).schur_complement());
  state.counters["unknowns"] = static_cast<double>(matrix.rows());
}
BENCHMARK(Supernodal)->Apply(sizes);

void ColumnByColumn(benchmark::State& state) {
  const Eigen::SparseMatrix<double> matrix = block(state);
  const Eigen::Index kept = matrix.rows() / 20, first = matrix.rows() - kept;
  for (auto _ : state) {
    using Permutation = Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int>;
    Permutation sequence;
    Eigen::AMDOrdering<int>()(Eigen::SparseMatrix<double>(matrix.topLeftCorner(first, first)), sequence);
    Eigen::VectorXi all = Eigen::VectorXi::LinSpaced(matrix.rows(), 0, static_cast<int>(matrix.rows()) - 1);
    all.head(first) = sequence.indices();
    Eigen::SparseMatrix<double> ordered;
    ordered = matrix.twistedBy(Permutation(Permutation(all).inverse()));
    const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>, Eigen::Lower, Eigen::NaturalOrdering<int>> llt(
        ordered);
    const Eigen::SparseMatrix<double> lower = llt.matrixL();
    const Eigen::MatrixXd last = lower.bottomRightCorner(kept, kept);
    benchmark::DoNotOptimize(Eigen::MatrixXd(last.triangularView<Eigen::Lower>() * last.transpose()));
  }
  state.counters["unknowns"] = static_cast<double>(matrix.rows());
}
BENCHMARK(ColumnByColumn)->Apply(sizes);

} // namespace
} // namespace spall
