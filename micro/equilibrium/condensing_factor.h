#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <vector>

namespace spall {

/// Cholesky factor of a sparse symmetric matrix
///
///   K = [K11 K12; K21 K22] = L L^T,  L = [L11 0; L21 L22],
///
/// whose last rows are kept: it gives the Schur complement S = K22 - K21 K11^-1 K12 = L22 L22^T and solves
/// with K11. The factor is supernodal and left-looking (Ng and Peyton 1993, SIAM Journal on Scientific
/// Computing 14-5): neighbouring columns of nearly equal pattern are one dense block. Order and blocks come
/// from CHOLMOD of SuiteSparse (Chen, Davis, Hager and Rajamanickam 2008, ACM Transactions on Mathematical
/// Software 35-3), the dense algebra from Eigen. Each run and each thread gets the same bits.
class CondensingFactor {
public:
  /// @param matrix n x n in any unit; its lower triangle is read. K11 must be positive definite, S may be
  /// semidefinite.
  /// @param kept size of K22, 0 <= kept <= n
  /// @throws ComputationError if the factor is too large for the memory
  CondensingFactor(const Eigen::SparseMatrix<double>& matrix, Eigen::Index kept);

  /// Returns whether the factorisation succeeded. If not, the matrix is not positive definite, and nothing
  /// else may be called.
  bool positive_definite() const { return definite; }

  /// Returns S, kept x kept, in the unit of the matrix.
  Eigen::MatrixXd schur_complement() const;

  /// Returns K11^-1 right. `right` has n - kept rows and any number of columns.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& right) const;

private:
  /// Consecutive columns of L as a dense block. Its first rows are those of its columns.
  struct Supernode {
    Eigen::Index column = 0, columns = 0; ///< first column and their number
    std::vector<Eigen::Index> rows;       ///< ascending
    Eigen::MatrixXd values;               ///< rows x columns; above the diagonal without meaning

    auto diagonal() const { return values.topRows(columns); } ///< lower triangular
    auto below() const { return values.bottomRows(static_cast<Eigen::Index>(rows.size()) - columns); }
    auto rows_below() const { return std::vector<Eigen::Index>(rows.begin() + columns, rows.end()); }
  };

  void analyse(const Eigen::SparseMatrix<double>& matrix);
  bool factorise(const Eigen::SparseMatrix<double>& permuted);

  Eigen::Index eliminated;
  Eigen::VectorXd added; ///< what was added to the diagonal of K22
  /// Place of each row of the matrix in the order of elimination.
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> places;
  std::vector<Supernode> supernodes;
  bool definite = false;
};

} // namespace spall
