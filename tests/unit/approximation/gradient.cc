// Tests of the gradient operator and of its derivatives with xi.

#include "tests/unit/approximation/clouds.h"

#include <gtest/gtest.h>

namespace spall::test {
namespace {

constexpr Mat3 one = {1, 0, 0, 0, 1, 0, 0, 0, 1};

template<class T> using Derivatives = std::array<std::vector<T>, 12>;

template<class T> Derivatives<T> differentiate(Cloud<T>& cloud, const Mat<T>& inverse_support, T weight) {
  LinearBasisOperator<T> op{evaluate_moments<Ball<CubicSpline>, true>(cloud, Vec<T>{})};
  op.collect_derivatives(cloud);
  Derivatives<T> values;
  std::array<T*, 12> out;
  for (int k = 0; k < 12; ++k) {
    values[k].resize(cloud.size());
    out[k] = values[k].data();
  }
  op.template differentiate<true>(cloud, inverse_support, weight, out);
  return values;
}

template<class T> Derivatives<T> differentiate(Cloud<T>& cloud) {
  return differentiate<T>(cloud, {1, 0, 0, 0, 1, 0, 0, 0, 1}, 1);
}

/// Sum over the cloud of derivative `k` times the coordinate `c` (c < 3) or times 1 (c = 3).
template<class T> double applied(const Derivatives<T>& d, int k, const Cloud<T>& cloud, int c) {
  double sum = 0;
  for (std::size_t j = 0; j < cloud.size(); ++j)
    sum += static_cast<double>(d[k][j]) * (c < 3 ? static_cast<double>(cloud.xi[c][j]) : 1.0);
  return sum;
}

template<class T> double largest(const std::vector<T>& values) {
  double most = 0;
  for (const T v : values) most = std::max(most, std::abs(static_cast<double>(v)));
  return most;
}

template<class T> class Gradient : public ::testing::Test {};
using Precisions = ::testing::Types<float, double>;
TYPED_TEST_SUITE(Gradient, Precisions);

TYPED_TEST(Gradient, OfLinearsIsExactAndItsDerivativesVanish) {
  using T = TypeParam;
  for (auto& [name, cloud] : sound_clouds<T>()) {
    const auto d = differentiate(cloud);
    for (int i = 0; i < 3; ++i)
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(applied(d, i, cloud, c), i == c ? 1 : 0, 2 * round_off<T>) << name;
        for (int k = 0; k < 3; ++k)
          EXPECT_NEAR(applied(d, 3 + 3 * k + i, cloud, c), 0,
                      round_off<T> * (1 + 10 * largest(d[3 + 3 * k + i])))
              << name;
      }
  }
}

TYPED_TEST(Gradient, OfConstantsVanishesOverAnyCloud) {
  using T = TypeParam;
  auto clouds = sound_clouds<T>();
  for (auto& singular : singular_clouds<T>()) clouds.push_back(singular);
  for (auto& [name, cloud] : clouds) {
    const auto d = differentiate(cloud);
    for (int i = 0; i < 12; ++i)
      EXPECT_NEAR(applied(d, i, cloud, 3), 0, round_off<T> * (1 + 10 * largest(d[i]))) << name;
  }
}

TYPED_TEST(Gradient, WithoutDerivativesIsTheSame) {
  using T = TypeParam;
  for (auto& [name, cloud] : sound_clouds<T>()) {
    const auto all = differentiate(cloud);
    const LinearBasisOperator<T> op{evaluate_moments<Ball<CubicSpline>, true>(cloud, Vec<T>{})};
    Derivatives<T> only;
    std::array<T*, 12> out{};
    for (int k = 0; k < 3; ++k) only[k].resize(cloud.size()), out[k] = only[k].data();
    op.template differentiate<false>(cloud, {1, 0, 0, 0, 1, 0, 0, 0, 1}, T(1), out);
    for (int k = 0; k < 3; ++k) EXPECT_EQ(only[k], all[k]) << name;
  }
}

TEST(GradientDerivative, IsTheChangeOfTheGradientWhenTheEvaluationPointMoves) {
  const double h = 1e-5;
  auto clouds = sound_clouds<double>();
  for (auto& [name, cloud] : clouds) {
    const auto exact = differentiate(cloud);
    for (int k = 0; k < 3; ++k) {
      Cloud<double> ahead = cloud, behind = cloud;
      for (double& x : ahead.xi[k]) x -= h;
      for (double& x : behind.xi[k]) x += h;
      const auto plus = differentiate(ahead), minus = differentiate(behind);
      for (int i = 0; i < 3; ++i) {
        // The third derivative of the kernel jumps at the knots, so the difference quotient is of first order
        // there.
        const double tolerance = 1e-4 * (1 + largest(exact[3 + 3 * k + i]));
        for (std::size_t j = 0; j < cloud.size(); ++j)
          EXPECT_NEAR(exact[3 + 3 * k + i][j], (plus[i][j] - minus[i][j]) / (2 * h), tolerance) << name;
      }
    }
  }
}

TEST(GradientDerivative, SeesTheCurvatureOfAQuadraticOnASymmetricCloud) {
  // Over a centrally symmetric cloud d_k sum B_J f_J of f = xi_i xi_k is the derivative of the gradient of f,
  // up to the kernel's smearing: exactly 0 for other components and of the sign and size of the curvature for
  // its own.
  Cloud<double> cloud = lattice_cloud<double>(Part::bulk, 0.25, 0, one, 1);
  const auto d = differentiate(cloud);
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i) {
      double own = 0, other = 0;
      for (std::size_t j = 0; j < cloud.size(); ++j) {
        own += d[3 + 3 * k + i][j] * cloud.xi[i][j] * cloud.xi[k][j];
        other += d[3 + 3 * k + i][j] * cloud.xi[(i + 1) % 3][j] * cloud.xi[(i + 2) % 3][j] * (i == k);
      }
      EXPECT_NEAR(own, i == k ? 2 : 1, 0.05);
      EXPECT_NEAR(other, 0, 1e-12);
    }
}

TEST(GradientInSpace, TransformsWithTheSupportAndTheWeight) {
  const Mat3 a = {2, 0.3, -0.1, 0.2, 1.5, 0.4, 0, -0.2, 0.7};
  const double weight = 0.144;
  for (auto& [name, cloud] : sound_clouds<double>()) {
    const auto local = differentiate(cloud), space = differentiate(cloud, a, weight);
    for (std::size_t j = 0; j < cloud.size(); ++j)
      for (int set = 0; set < 4; ++set)
        for (int i = 0; i < 3; ++i) {
          // x = A^-1 xi, so d/dx_i = sum_k A_ki d/dxi_k.
          double expected = 0;
          for (int k = 0; k < 3; ++k) expected += a[3 * k + i] * local[3 * set + k][j];
          EXPECT_NEAR(space[3 * set + i][j], (set > 0 ? weight : 1) * expected,
                      1e-11 * (1 + largest(local[3 * set + i])));
        }
  }
}

TEST(Regularisation, ShrinksTheGradientAlongUnresolvedDirectionsOnly) {
  auto clouds = singular_clouds<double>();
  for (auto& [name, cloud] : clouds) {
    const auto d = differentiate(cloud);
    // The gradient of the linear field t . xi along a unit vector t: at most 1, positive if the cloud extends
    // along t.
    std::mt19937 engine(1);
    std::normal_distribution<double> normal;
    for (int n = 0; n < 20; ++n) {
      double t[3] = {normal(engine), normal(engine), normal(engine)};
      const double norm = std::hypot(t[0], t[1], t[2]);
      double along = 0;
      for (int i = 0; i < 3; ++i)
        for (int c = 0; c < 3; ++c) along += t[i] * t[c] / (norm * norm) * applied(d, i, cloud, c);
      EXPECT_GE(along, -1e-12) << name;
      EXPECT_LE(along, 1 + 1e-12) << name;
    }
  }
  // The normal of the plane cloud is not resolved at all, its tangents nearly in full.
  auto& plane = clouds[2].cloud;
  const auto d = differentiate(plane);
  const double n[3] = {-0.1, 0.05, 0.2}; // normal of z = 0.5 x - 0.25 y, times 0.2
  for (int i = 0; i < 3; ++i) {
    double gradient = 0;
    for (std::size_t j = 0; j < plane.size(); ++j)
      gradient += d[i][j] * (n[0] * plane.xi[0][j] + n[1] * plane.xi[1][j] + n[2] * plane.xi[2][j]);
    EXPECT_NEAR(gradient, 0, 1e-12);
  }
  EXPECT_GT(applied(d, 0, plane, 0), 0.7);
}

} // namespace
} // namespace spall::test
