#include "macro/solid/lanczos.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace spall::test {
namespace {

/// Applies the stiffness of a chain of n unit masses and springs with fixed ends, with the eigenvalues 2 - 2
/// cos(k pi / (n + 1)).
void chain(const std::vector<double>& x, std::vector<double>& y) {
  for (std::size_t i = 0; i < x.size(); ++i)
    y[i] = 2 * x[i] - (i > 0 ? x[i - 1] : 0) - (i + 1 < x.size() ? x[i + 1] : 0);
}

TEST(Lanczos, FindsTheLargestEigenvalueOfAChainWithinItsResidual) {
  for (const std::size_t n : {1, 2, 10, 100}) {
    const double exact =
        2 - 2 * std::cos(std::numbers::pi * static_cast<double>(n) / static_cast<double>(n + 1));
    const EigenvalueEstimate e = largest_eigenvalue(n, chain, 0.01, 200);
    EXPECT_LE(e.value, exact * (1 + 1e-12));
    EXPECT_GE(e.value + e.residual, exact * (1 - 1e-12));
    EXPECT_LE(e.residual, 0.01 * e.value);
  }
}

TEST(Lanczos, NeedsFewApplicationsWhenOneEigenvalueStandsOut) {
  const auto one_large = [](const std::vector<double>& x, std::vector<double>& y) {
    for (std::size_t i = 0; i < x.size(); ++i)
      y[i] = x[i] * (i == 500 ? 10 : 1 + 1e-3 * static_cast<double>(i));
  };
  const EigenvalueEstimate e = largest_eigenvalue(1000, one_large, 1e-6, 100);
  EXPECT_NEAR(e.value, 10, 1e-5);
  EXPECT_LT(e.applications, 20);
}

TEST(Lanczos, StopsAtTheLimitWithTheResidualItHas) {
  const EigenvalueEstimate e = largest_eigenvalue(1000, chain, 1e-12, 5);
  EXPECT_EQ(e.applications, 5);
  EXPECT_GT(e.residual, 0);
}

} // namespace
} // namespace spall::test
