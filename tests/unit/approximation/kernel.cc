#include "macro/approximation/kernel.h"

#include "tests/unit/approximation/clouds.h"

#include <gtest/gtest.h>

#include <numbers>

namespace spall::test {
namespace {

template<class K> class ProfileTest : public ::testing::Test {};
using Profiles = ::testing::Types<CubicSpline, WendlandC4>;
TYPED_TEST_SUITE(ProfileTest, Profiles);

TYPED_TEST(ProfileTest, IsPositiveDecreasingAndEndsAtTheUnitBall) {
  using K = TypeParam;
  double last = K::value(0.0);
  for (double r = 0.001; r < 0.9; r += 0.001) {
    EXPECT_GT(K::value(r), 0);
    EXPECT_LT(K::value(r), last);
    last = K::value(r);
  }
  for (const double r : {1.0, 1.1, 50.0}) {
    EXPECT_EQ(K::value(r), 0);
    EXPECT_EQ(K::slope_over_radius(r), 0);
  }
}

TYPED_TEST(ProfileTest, TheSlopeIsTheDerivativeOfTheValue) {
  using K = TypeParam;
  const double h = 1e-6;
  for (double r = 0.01; r < 1.2; r += 0.00937) {
    const double difference = (K::value(r + h) - K::value(r - h)) / (2 * h);
    EXPECT_NEAR(K::slope_over_radius(r) * r, difference, 1e-5) << r;
  }
  const double curvature = 2 * (K::value(1e-4) - K::value(0.0)) / 1e-8;
  EXPECT_NEAR(K::slope_over_radius(0.0) / curvature, 1,
              1e-3); // the limit at the centre is the second derivative
}

TYPED_TEST(ProfileTest, ValueSlopeAndCurvatureAreContinuousAtTheKnots) {
  using K = TypeParam;
  const double e = 1e-7;
  for (const double knot : {0.5, 1.0}) {
    EXPECT_NEAR(K::value(knot - e), K::value(knot + e), 2e-6);
    EXPECT_NEAR(K::slope_over_radius(knot - e), K::slope_over_radius(knot + e), 2e-5);
    const auto curvature = [&](double r) {
      return ((r + e) * K::slope_over_radius(r + e) - (r - e) * K::slope_over_radius(r - e)) / (2 * e);
    };
    EXPECT_NEAR(curvature(knot - 2 * e), curvature(knot + 2 * e), 1e-4);
  }
}

/// Integral of r^power phi over the radius by the midpoint rule.
template<class K> double radial(int power) {
  double sum = 0;
  const int n = 200000;
  for (int i = 0; i < n; ++i) {
    const double r = (i + 0.5) / n;
    sum += std::pow(r, power) * K::value(r) / n;
  }
  return sum;
}

TYPED_TEST(ProfileTest, MomentsOfDenseCloudsAreTheDocumentedConstants) {
  using K = TypeParam;
  // Over the sphere <x^2> = r^2 / 3 and <x^4> = r^4 / 5.
  EXPECT_NEAR(radial<K>(4) / radial<K>(2) / 3, K::ball_second, 1e-9);
  EXPECT_NEAR(radial<K>(6) / radial<K>(2) / 5, K::ball_fourth, 1e-9);
  EXPECT_NEAR(radial<K>(2) / radial<K>(0), K::line_second, 1e-9);
  EXPECT_NEAR(radial<K>(4) / radial<K>(0), K::line_fourth, 1e-9);
}

template<class Kernel> void expect_slopes_are_derivatives() {
  const double h = 1e-6;
  for (const Vec3& x : {Vec3{0.2, -0.3, 0.1}, {-0.6, 0.05, 0.4}, {0, 0, 0}})
    for (int k = 0; k < 3; ++k) {
      auto a = x, b = x;
      a[k] += h, b[k] -= h;
      const double difference = (Kernel::value(a[0], a[1], a[2]) - Kernel::value(b[0], b[1], b[2])) / (2 * h);
      EXPECT_NEAR(Kernel::slope(x[0], x[1], x[2])[k], difference, 1e-5);
    }
}

TEST(Kernel, SlopesAreTheDerivativesOfTheValue) {
  expect_slopes_are_derivatives<Ball<CubicSpline>>();
  expect_slopes_are_derivatives<Ball<WendlandC4>>();
  expect_slopes_are_derivatives<Box<CubicSpline>>();
  expect_slopes_are_derivatives<Box<WendlandC4>>();
}

TEST(Kernel, TheBallEndsAtRadiusOneTheBoxAtItsFaces) {
  using B = Ball<CubicSpline>;
  using C = Box<CubicSpline>;
  EXPECT_EQ(B::value(0.7, 0.7, 0.7), 0);
  EXPECT_GT(C::value(0.7, 0.7, 0.7), 0);
  EXPECT_EQ(C::value(0.1, 1.0, 0.1), 0);
  EXPECT_DOUBLE_EQ(C::value(0.2, 0.0, 0.0),
                   CubicSpline::value(0.2) * CubicSpline::value(0.0) * CubicSpline::value(0.0));
}

using K = CubicSpline;

/// Returns the determinant of the second moment of a cloud as a fraction of that in the bulk.
double fraction(Cloud<double> cloud) {
  const auto m = evaluate_moments<Ball<K>, false>(cloud, Vec3{});
  if (m.regularized) return 0;
  const auto& i = m.inverse;
  const double inverse = i[0] * (i[1] * i[2] - i[4] * i[4]) - i[3] * (i[3] * i[2] - i[4] * i[5]) +
                         i[5] * (i[3] * i[4] - i[1] * i[5]);
  return 1 / (inverse * std::pow(K::ball_second * m.mu0, 3));
}

TEST(SecondMoment, DenseCloudsAtSurfacesHaveTheClosedForms) {
  // Half ball: the mean moves by <|x|> = (1/2) <r> along the normal; corner: along all axes, <xy> = 2 <r^2> /
  // (3 pi).
  constexpr Mat3 none = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  const double bulk = radial<K>(4) / radial<K>(2) / 3, mean = 0.5 * radial<K>(3) / radial<K>(2);
  const double d = 1 - mean * mean / bulk, o = 2 / std::numbers::pi - mean * mean / bulk;
  EXPECT_NEAR(d, 0.346, 1e-3);
  EXPECT_NEAR(d * d - o * o, 0.120, 1e-3);
  EXPECT_NEAR((d - o) * (d - o) * (d + 2 * o), 0.0412, 1e-4);
  // A fine lattice converges to them from above (the points on the surface count in full).
  const double fine = 0.05;
  EXPECT_NEAR(fraction(lattice_cloud<double>(Part::bulk, fine, 0, none, 1)), 1, 0.01);
  EXPECT_NEAR(fraction(lattice_cloud<double>(Part::face, fine, 0, none, 1)), d, 0.03);
  EXPECT_NEAR(fraction(lattice_cloud<double>(Part::corner, fine, 0, none, 1)), 0.0412, 0.02);
}

TEST(SecondMoment, NoSoundLatticeIsNearTheLimitOfRegularisation) {
  // Support of two spacings: the default. Values of the comment of singular_fraction.
  constexpr Mat3 none = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  EXPECT_NEAR(fraction(lattice_cloud<double>(Part::bulk, 0.5, 0, none, 1)), 0.99, 0.01);
  EXPECT_NEAR(fraction(lattice_cloud<double>(Part::face, 0.5, 0, none, 1)), 0.51, 0.01);
  EXPECT_NEAR(fraction(lattice_cloud<double>(Part::edge, 0.5, 0, none, 1)), 0.26, 0.01);
  EXPECT_NEAR(fraction(lattice_cloud<double>(Part::corner, 0.5, 0, none, 1)), 0.13, 0.01);
  for (const auto& [name, cloud] : sound_clouds<double>())
    EXPECT_GT(fraction(cloud), singular_fraction) << name;
  for (const auto& [name, cloud] : singular_clouds<double>()) EXPECT_EQ(fraction(cloud), 0) << name;
}

} // namespace
} // namespace spall::test
