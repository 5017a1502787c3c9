#include "macro/solid/conjugate_gradients.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace spall::test {
namespace {

/// Applies the stiffness of a chain of unit springs with free ends: positive semidefinite, and zero for
/// constants.
void free_chain(const std::vector<double>& x, std::vector<double>& y) {
  const std::size_t n = x.size();
  for (std::size_t i = 0; i < n; ++i)
    y[i] = (i > 0 ? x[i] - x[i - 1] : 0) + (i + 1 < n ? x[i] - x[i + 1] : 0);
}

TEST(ConjugateGradients, SolveAConsistentSemidefiniteSystem) {
  std::vector<double> right(40), solution, image(40);
  right.front() = 1, right.back() = -1; // forces at both ends stretch every spring by 1
  const std::vector<double> wanted = right;
  const SolverReport report = solve_symmetric(free_chain, right, solution);
  EXPECT_TRUE(report.converged);
  EXPECT_LE(report.iterations, 40);
  EXPECT_LE(report.residual, solver_tolerance);
  free_chain(solution, image);
  for (std::size_t i = 0; i < 40; ++i) {
    EXPECT_NEAR(image[i], wanted[i], 1e-7);
    EXPECT_NEAR(wanted[i] - image[i], right[i], 1e-12); // the solution has the returned residual
    if (i > 0) {
      EXPECT_NEAR(solution[i - 1] - solution[i], 1, 1e-6);
    }
  }
}

TEST(ConjugateGradients, ReportThatTheyHaveNotConvergedAtTheLimit) {
  std::vector<double> right(40), solution;
  right.front() = 1, right.back() = -1;
  const SolverReport report = solve_symmetric(free_chain, right, solution, {}, 5);
  EXPECT_FALSE(report.converged);
  EXPECT_EQ(report.iterations, 5);
  EXPECT_GT(report.residual, solver_tolerance);
}

TEST(ConjugateGradients, ReportASystemWithoutSolution) {
  std::vector<double> right(40, 1.0), solution; // every image of the stiffness adds up to zero
  EXPECT_FALSE(solve_symmetric(free_chain, right, solution).converged);
  right.assign(40, std::numeric_limits<double>::quiet_NaN());
  EXPECT_FALSE(solve_symmetric(free_chain, right, solution).converged);
}

TEST(ConjugateGradients, NeedNoStepForZero) {
  std::vector<double> right(40, 0.0), solution;
  const SolverReport report = solve_symmetric(free_chain, right, solution);
  EXPECT_TRUE(report.converged);
  EXPECT_EQ(report.iterations, 0);
  EXPECT_EQ(solution, right);
}

} // namespace
} // namespace spall::test
