// The sparse factor against dense algebra, on the stiffnesses of lattices of springs.

#include "micro/equilibrium/condensing_factor.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <thread>
#include <utility>
#include <vector>

namespace {

using namespace spall;
using Eigen::Index;
using Eigen::MatrixXd;

/// Returns the stiffness of a lattice of points, joined to their neighbours by springs and to the ground by
/// weak ones, in random order.
Eigen::SparseMatrix<double> lattice(std::array<int, 3> points, double ground, unsigned seed) {
  const int count = points[0] * points[1] * points[2];
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> spring(0.5, 2);
  std::vector<int> place(count);
  for (int i = 0; i < count; ++i) place[i] = i;
  std::shuffle(place.begin(), place.end(), engine);
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < count; ++i) {
    entries.emplace_back(i, i, ground);
    const std::array<int, 3> at = {i % points[0], i / points[0] % points[1], i / (points[0] * points[1])},
                             stride = {1, points[0], points[0] * points[1]};
    for (int c = 0; c < 3; ++c) {
      if (at[c] + 1 == points[c]) continue;
      const int a = place[i], b = place[i + stride[c]];
      const double k = spring(engine);
      for (const auto& [row, column] : {std::pair{a, b}, std::pair{b, a}}) {
        entries.emplace_back(row, column, -k);
        entries.emplace_back(row, row, k);
      }
    }
  }
  Eigen::SparseMatrix<double> matrix(count, count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

MatrixXd dense_schur_complement(const MatrixXd& matrix, Index kept) {
  const Index first = matrix.rows() - kept;
  return matrix.bottomRightCorner(kept, kept) -
         matrix.bottomLeftCorner(kept, first) *
             matrix.topLeftCorner(first, first).llt().solve(matrix.topRightCorner(first, kept));
}

TEST(CondensingFactor, SchurComplementAndSolutionAreThoseOfDenseAlgebra) {
  for (const auto& points : {std::array{17, 13, 1}, std::array{9, 8, 7}})
    for (const int kept : {0, 1, 40}) {
      const auto matrix = lattice(points, 0.1, 3);
      const CondensingFactor factor(matrix, kept);
      ASSERT_TRUE(factor.positive_definite());
      const MatrixXd dense = matrix, expected = dense_schur_complement(dense, kept);
      EXPECT_LE((factor.schur_complement() - expected).norm(), 1e-12 * expected.norm()) << kept;
      const Index first = dense.rows() - kept;
      const MatrixXd right =
          MatrixXd::NullaryExpr(first, 3, [](Index i, Index j) { return std::sin(i + j); });
      const MatrixXd solution = factor.solve(right);
      ASSERT_EQ(solution.rows(), first);
      EXPECT_LE((dense.topLeftCorner(first, first) * solution - right).norm(), 1e-11 * right.norm()) << kept;
    }
}

// A lattice without ground can move as a whole: its Schur complement is singular, and says so by a sum of
// zero.
TEST(CondensingFactor, SchurComplementMayBeSemidefinite) {
  const CondensingFactor factor(lattice({9, 8, 7}, 0, 4), 30);
  ASSERT_TRUE(factor.positive_definite());
  const MatrixXd schur = factor.schur_complement();
  EXPECT_LE((schur * Eigen::VectorXd::Ones(30)).norm(), 1e-12 * schur.norm());
}

TEST(CondensingFactor, IndefiniteMatricesAreToldApart) {
  EXPECT_FALSE(CondensingFactor(lattice({9, 8, 7}, -8, 5), 30).positive_definite());
}

// Large enough that nested dissection is preferred, which draws random numbers.
TEST(CondensingFactor, RepeatsItsBitsOnThreadsAtOnce) {
  const auto matrix = lattice({24, 24, 24}, 0.1, 6);
  const MatrixXd alone = CondensingFactor(matrix, 100).schur_complement();
  std::array<MatrixXd, 3> at_once;
  std::vector<std::thread> threads;
  for (MatrixXd& result : at_once)
    threads.emplace_back([&] { result = CondensingFactor(matrix, 100).schur_complement(); });
  for (std::thread& thread : threads) thread.join();
  for (const MatrixXd& result : at_once) EXPECT_EQ(result, alone);
}

} // namespace
