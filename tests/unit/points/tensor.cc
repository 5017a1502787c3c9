#include "macro/points/tensor.h"

#include <gtest/gtest.h>

#include <random>

namespace spall::test {
namespace {

class RandomTensor {
public:
  Mat3 operator()() {
    Mat3 a;
    for (double& x : a) x = range(engine);
    return a;
  }

private:
  std::mt19937 engine{3};
  std::uniform_real_distribution<double> range{-1, 1};
};

TEST(Tensor, InverseTimesTensorIsIdentityAndDeterminantsMultiply) {
  RandomTensor random;
  for (int n = 0; n < 100; ++n) {
    const Mat3 a = random(), b = random();
    if (std::abs(determinant(a)) < 0.05) continue;
    const Mat3 one = multiply(inverse(a), a);
    for (int i = 0; i < 9; ++i) EXPECT_NEAR(one[i], identity3[i], 1e-12);
    EXPECT_NEAR(determinant(multiply(a, b)), determinant(a) * determinant(b), 1e-13);
  }
}

TEST(Tensor, TimesTransposeIsTheProductWithTheTranspose) {
  RandomTensor random;
  const Mat3 a = random(), full = multiply(a, transpose(a));
  const Sym3 s = times_transpose(a);
  const int place[6] = {0, 4, 8, 1, 5, 2};
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(s[i], full[place[i]], 1e-15);
}

TEST(Tensor, ContractionCountsShearTwice) {
  const Sym3 a = {1, 2, 3, 4, 5, 6}, b = {7, 8, 9, 10, 11, 12};
  EXPECT_EQ(contract(a, b), 7 + 16 + 27 + 2 * (40 + 55 + 72));
  EXPECT_NEAR(trace(deviator(a)), 0, 1e-15);
}

TEST(Tensor, UniaxialAndShearEquivalentStress) {
  EXPECT_NEAR(equivalent_stress(deviator(Sym3{-5, 0, 0, 0, 0, 0})), 5, 1e-14);
  EXPECT_NEAR(equivalent_stress(deviator(Sym3{0, 0, 0, 0, 2, 0})), 2 * std::sqrt(3), 1e-14);
  EXPECT_NEAR(equivalent_stress(deviator(Sym3{4, 4, 4, 0, 0, 0})), 0, 1e-14);
}

TEST(Tensor, LargestEigenvalueIsTheLargestRayleighQuotient) {
  EXPECT_NEAR(largest_eigenvalue({3, 1, 2, 0, 0, 0}), 3, 1e-14);
  EXPECT_NEAR(largest_eigenvalue({2, 2, 2, 0, 0, 0}), 2, 1e-14);
  EXPECT_NEAR(largest_eigenvalue({0, 0, 0, 0, 1, 0}), 1, 1e-14);
  RandomTensor random;
  for (int n = 0; n < 50; ++n) {
    const Mat3 a = random();
    const Sym3 s = times_transpose(a);
    const double largest = largest_eigenvalue(s);
    // No direction exceeds it, and s - largest is singular.
    const Mat3 shifted = {s[0] - largest, s[3], s[5], s[3], s[1] - largest, s[4], s[5], s[4], s[2] - largest};
    EXPECT_NEAR(determinant(shifted), 0, 1e-12);
    const Mat3 v = random();
    const double norm = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    const double quotient = (s[0] * v[0] * v[0] + s[1] * v[1] * v[1] + s[2] * v[2] * v[2] +
                             2 * (s[3] * v[0] * v[1] + s[4] * v[1] * v[2] + s[5] * v[0] * v[2])) /
                            norm;
    EXPECT_LE(quotient, largest + 1e-12);
  }
}

} // namespace
} // namespace spall::test
