#include "micro/equilibrium/sparse_cholesky.h"

#include "shared/error.h"

#include <Eigen/CholmodSupport>

namespace spall {

struct SparseCholesky::Factor {
  Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<double>> cholesky;
};

SparseCholesky::SparseCholesky() : factor(std::make_unique<Factor>()) {}
SparseCholesky::~SparseCholesky() = default;

void SparseCholesky::initialize(const dealii::SparseMatrix<double>& matrix) {
  const auto n = static_cast<Eigen::Index>(matrix.m());
  Eigen::SparseMatrix<double> lower(n, n);
  // Rows of deal.II's matrix are columns of Eigen's: the upper triangle becomes the lower one.
  std::vector<Eigen::Triplet<double>> entries;
  for (const auto& entry : matrix)
    if (entry.column() >= entry.row())
      entries.emplace_back(static_cast<int>(entry.column()), static_cast<int>(entry.row()), entry.value());
  lower.setFromTriplets(entries.begin(), entries.end());
  factor->cholesky.compute(lower);
  if (factor->cholesky.info() != Eigen::Success)
    throw ComputationError("the stiffness of the cell is not positive definite");
}

void SparseCholesky::solve(dealii::Vector<double>& vector) const {
  Eigen::Map<Eigen::VectorXd> values(vector.begin(), static_cast<Eigen::Index>(vector.size()));
  values = factor->cholesky.solve(values).eval();
}

} // namespace spall
