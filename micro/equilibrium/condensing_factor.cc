#include "micro/equilibrium/condensing_factor.h"

#include "shared/error.h"

#include <Eigen/Cholesky>
#include <Eigen/CholmodSupport>

#include <algorithm>
#include <memory>
#include <mutex>
#include <new>

namespace spall {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Sparse = Eigen::SparseMatrix<double>;

/// CHOLMOD's settings and work space.
struct Cholmod {
  cholmod_common common;
  Cholmod() {
    cholmod_start(&common);
    common.print = 0; // failures are reported by exceptions
    common.supernodal = CHOLMOD_SUPERNODAL;
  }
  ~Cholmod() { cholmod_finish(&common); }
  Cholmod(const Cholmod&) = delete;
  Cholmod& operator=(const Cholmod&) = delete;

  /// Returns order and pattern of the factor of a symmetric matrix, of which the lower triangle is read.
  /// @param order order of elimination; null: CHOLMOD's choice, approximate minimum degree, or nested
  /// dissection (METIS) where that fills in less
  auto analyse(const Sparse& matrix, int* order) {
    cholmod_sparse view = Eigen::viewAsCholmod(matrix.selfadjointView<Eigen::Lower>());
    const auto release = [this](cholmod_factor* factor) { cholmod_free_factor(&factor, &common); };
    std::unique_ptr<cholmod_factor, decltype(release)> factor(
        order ? cholmod_analyze_p(&view, order, nullptr, 0, &common) : cholmod_analyze(&view, &common),
        release);
    if (!factor) throw ComputationError("the factor of the solid's stiffness is too large for the memory");
    return factor;
  }
};

} // namespace

// One kind of factor serves all sizes. Processor seconds for the stiffness of cells, on one core (AVX-512),
// with what else was tried: Eigen's SimplicialLLT with minimum degree (column by column), CHOLMOD's own dense
// blocks with the reference BLAS and with OpenBLAS.
//
//   rows of K, kept      this     column by column   CHOLMOD, reference   CHOLMOD, OpenBLAS
//   2D  2,098,    84     0.010    0.016              0.018                0.010
//   2D 16,642,   228     0.09     0.22 to 0.31       0.26                 0.17
//   3D  3,885,   432     0.15     0.9 to 1.1         0.6                  0.19
//   3D 10,761,   828     0.8      14                 4.5                  0.8 to 1.8
//   3D 19,581, 1,152     2.4      85                 12                   1.7 to 3.6
//
// CHOLMOD's numerical part calls the BLAS that happens to be installed. That of libopenblas0-serial is not
// safe on several threads, which the samples of an ensemble are computed on: some of them failed. Of the last
// row's gain nested dissection gives a factor of 3.4 in operations. A factor of K11 alone, solved for the
// columns of K12, takes 2 to 3 times as long as one that goes on to the last rows.
CondensingFactor::CondensingFactor(const Sparse& matrix, Index kept)
    : eliminated(matrix.rows() - kept), added(matrix.diagonal().tail(kept)) {
  analyse(matrix);
  // S may be only semidefinite, so its own diagonal is added before the factorisation and subtracted
  // afterwards.
  Sparse permuted(matrix.rows(), matrix.cols());
  permuted.selfadjointView<Eigen::Lower>() = matrix.selfadjointView<Eigen::Lower>().twistedBy(places);
  for (Index i = 0; i < kept; ++i) permuted.coeffRef(eliminated + i, eliminated + i) += added[i];
  try {
    definite = factorise(permuted);
  } catch (const std::bad_alloc&) {
    throw ComputationError("the factor of the solid's stiffness is too large for the memory");
  }
}

/// Finds order and supernodes.
void CondensingFactor::analyse(const Sparse& matrix) {
  Cholmod cholmod;
  std::vector<int> order(matrix.rows());
  for (Index i = 0; i < matrix.rows(); ++i) order[i] = static_cast<int>(i);
  {
    // METIS draws from rand(), which it seeds itself: two threads at once would get other orders, so other
    // bits.
    static std::mutex one_at_a_time;
    const std::lock_guard<std::mutex> lock(one_at_a_time);
    const auto first = cholmod.analyse(matrix.topLeftCorner(eliminated, eliminated), nullptr);
    std::copy_n(static_cast<const int*>(first->Perm), eliminated, order.begin());
  }
  // The order is kept as it is: what is eliminated is postordered already, and the kept rows must stay last.
  cholmod.common.nmethods = 1;
  cholmod.common.method[0].ordering = CHOLMOD_GIVEN;
  cholmod.common.postorder = false;
  const auto pattern = cholmod.analyse(matrix, order.data());
  places.resize(matrix.rows());
  for (Index i = 0; i < matrix.rows(); ++i) places.indices()[order[i]] = static_cast<int>(i);
  const auto *column = static_cast<const int*>(pattern->super),
             *first_row = static_cast<const int*>(pattern->pi), *rows = static_cast<const int*>(pattern->s);
  for (std::size_t k = 0; k < pattern->nsuper; ++k)
    supernodes.push_back({.column = column[k],
                          .columns = column[k + 1] - column[k],
                          .rows = std::vector<Index>(rows + first_row[k], rows + first_row[k + 1]),
                          .values = {}});
}

/// Fills the supernodes from left to right. Returns whether the matrix is positive definite.
bool CondensingFactor::factorise(const Sparse& permuted) {
  std::vector<std::size_t> owner(permuted.rows()); // supernode of each column
  for (std::size_t k = 0; k < supernodes.size(); ++k)
    std::fill_n(owner.begin() + supernodes[k].column, supernodes[k].columns, k);
  // A finished supernode waits at the one that owns its next row, to subtract its part there.
  std::vector<std::vector<std::size_t>> waiting(supernodes.size());
  std::vector<Index> next(supernodes.size()); // the number of that row in the waiting supernode
  const auto queue = [&](std::size_t k) {
    if (next[k] < static_cast<Index>(supernodes[k].rows.size()))
      waiting[owner[supernodes[k].rows[next[k]]]].push_back(k);
  };
  std::vector<Index> at(permuted.rows()); // number of a row in the present supernode
  MatrixXd part;
  for (std::size_t k = 0; k < supernodes.size(); ++k) {
    Supernode& node = supernodes[k];
    const Index rows = static_cast<Index>(node.rows.size());
    for (Index i = 0; i < rows; ++i) at[node.rows[i]] = i;
    node.values.setZero(rows, node.columns);
    for (Index j = 0; j < node.columns; ++j)
      for (Sparse::InnerIterator entry(permuted, node.column + j); entry; ++entry)
        node.values(at[entry.row()], j) = entry.value();

    for (const std::size_t d : waiting[k]) {
      const Supernode& done = supernodes[d];
      const Index from = next[d], end = node.column + node.columns,
                  left = static_cast<Index>(done.rows.size()) - from;
      const Index here =
          std::lower_bound(done.rows.begin() + from, done.rows.end(), end) - done.rows.begin() - from;
      part.noalias() = done.values.bottomRows(left) * done.values.middleRows(from, here).transpose();
      for (Index j = 0; j < here; ++j) {
        auto target = node.values.col(done.rows[from + j] - node.column);
        for (Index i = j; i < left; ++i) target[at[done.rows[from + i]]] -= part(i, j);
      }
      next[d] += here;
      queue(d);
    }

    Eigen::Ref<MatrixXd> diagonal = node.values.topRows(node.columns);
    if (Eigen::LLT<Eigen::Ref<MatrixXd>>(diagonal).info() != Eigen::Success) return false;
    if (rows > node.columns) {
      auto below = node.values.bottomRows(rows - node.columns);
      node.diagonal().transpose().triangularView<Eigen::Upper>().solveInPlace<Eigen::OnTheRight>(below);
    }
    next[k] = node.columns;
    queue(k);
  }
  return true;
}

MatrixXd CondensingFactor::schur_complement() const {
  if (added.size() == 0) return {}; // Eigen's triangular product takes no empty matrix
  MatrixXd last = MatrixXd::Zero(added.size(), added.size());
  for (const Supernode& node : supernodes)
    for (Index j = std::max<Index>(0, eliminated - node.column); j < node.columns; ++j)
      for (Index i = j; i < static_cast<Index>(node.rows.size()); ++i)
        last(node.rows[i] - eliminated, node.column + j - eliminated) = node.values(i, j);
  MatrixXd schur = last.triangularView<Eigen::Lower>() * last.transpose();
  schur.diagonal() -= added;
  return schur;
}

MatrixXd CondensingFactor::solve(const MatrixXd& right) const {
  MatrixXd x = MatrixXd::Zero(places.size(), right.cols());
  x.topRows(eliminated) = right;
  x = places * x;
  for (const Supernode& node : supernodes) {
    auto own = x.middleRows(node.column, node.columns);
    node.diagonal().triangularView<Eigen::Lower>().solveInPlace(own);
    x(node.rows_below(), Eigen::all) -= node.below() * own;
  }
  // With zeros for the kept rows between the two substitutions, L L^T acts as L11 L11^T.
  x.bottomRows(added.size()).setZero();
  for (auto node = supernodes.rbegin(); node != supernodes.rend(); ++node) {
    auto own = x.middleRows(node->column, node->columns);
    own -= node->below().transpose() * x(node->rows_below(), Eigen::all);
    node->diagonal().transpose().triangularView<Eigen::Upper>().solveInPlace(own);
  }
  x = places.transpose() * x;
  return x.topRows(eliminated);
}

} // namespace spall
