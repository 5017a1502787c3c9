#include "macro/approximation/support.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace spall::test {
namespace {

constexpr double h = 0.37;
constexpr SupportInputs inputs{.normalized_size = 2, .min_stretch = 0.5, .max_stretch = 4};

Mat3 rotation(double a, double b) {
  const Mat3 z = {std::cos(a), -std::sin(a), 0, std::sin(a), std::cos(a), 0, 0, 0, 1};
  const Mat3 x = {1, 0, 0, 0, std::cos(b), -std::sin(b), 0, std::sin(b), std::cos(b)};
  return multiply(z, x);
}
Mat3 diagonal(double a, double b, double c) { return {a, 0, 0, 0, b, 0, 0, 0, c}; }
/// Returns W diag(a, b, c) Z^T with two rotations about skew axes.
Mat3 stretched(double a, double b, double c) {
  return multiply(multiply(rotation(0.4, 1.1), diagonal(a, b, c)), transpose(rotation(-0.9, 0.3)));
}

void expect_matrix(const Mat3& found, const Mat3& expected, double tolerance) {
  for (int i = 0; i < 9; ++i) EXPECT_NEAR(found[i], expected[i], tolerance) << "component " << i;
}
Mat3 times(double s, Mat3 a) {
  for (double& x : a) x *= s;
  return a;
}

TEST(Support, IsTheSupportSizeTimesTheDeformationInsideTheRange) {
  for (const Mat3& f : {identity3, rotation(0.3, 2), stretched(0.6, 1, 3.5), stretched(1.2, 1.2, 0.7),
                        Mat3{1, 0.5, 0, 0, 1, 0, 0, 0, 1}}) {
    const Support s = make_support(f, h, inputs);
    expect_matrix(s.matrix, times(2 * h, f), 1e-12);
    expect_matrix(multiply(s.matrix, s.inverse), identity3, 1e-12);
  }
}

TEST(Support, ClipsThePrincipalStretchesAndLeavesTheirAxes) {
  const double values[][6] = {{0.1, 1, 2, 0.5, 1, 2},        {0.7, 1, 9, 0.7, 1, 4},
                              {0.01, 0.3, 100, 0.5, 0.5, 4}, {10, 10, 10, 4, 4, 4},
                              {0.1, 0.1, 0.1, .5, .5, .5},   {1, 1, 20, 1, 1, 4}};
  for (const auto& v : values) {
    const Support s = make_support(stretched(v[0], v[1], v[2]), h, inputs);
    // The stretches are computed from F^T F, so round-off grows with the square of their ratio.
    const double ratio = std::max({v[0], v[1], v[2]}) / std::min({v[0], v[1], v[2]}),
                 tolerance = 1e-9 + 3e-13 * ratio * ratio;
    expect_matrix(s.matrix, times(2 * h, stretched(v[3], v[4], v[5])), tolerance);
    EXPECT_NEAR(s.smallest_stretch, std::min({v[3], v[4], v[5]}), tolerance);
    expect_matrix(multiply(s.matrix, s.inverse), identity3, 1e-9);
  }
}

TEST(Support, TurnsWithTheMaterial) {
  const Mat3 q = rotation(1.3, -0.8);
  for (const Mat3& f : {stretched(0.1, 1, 2), stretched(0.7, 1.5, 9), stretched(1, 1.1, 1.2)})
    expect_matrix(make_support(multiply(q, f), h, inputs).matrix,
                  multiply(q, make_support(f, h, inputs).matrix), 1e-7);
}

TEST(Support, OfASingularOrMeaninglessDeformationIsASphere) {
  const double nan = std::nan("");
  for (const Mat3& f : {Mat3{}, diagonal(1, 1, 0), stretched(1e-8, 1, 1), diagonal(nan, 1, 1)}) {
    const Support s = make_support(f, h, inputs);
    expect_matrix(s.matrix, diagonal(2 * h, 2 * h, 2 * h), 1e-12);
    expect_matrix(s.inverse, diagonal(0.5 / h, 0.5 / h, 0.5 / h), 1e-12);
    EXPECT_EQ(s.smallest_stretch, 1);
  }
}

TEST(Support, HalfWidthsBoxTheEllipsoidTightly) {
  std::mt19937 engine(1);
  std::normal_distribution<double> normal;
  for (const Mat3& f : {identity3, stretched(0.6, 1, 3), Mat3{1, 0.9, 0, 0, 1, 0, 0, 0, 1}})
    for (const double radius : {1.0, 1.25}) {
      const Support s = make_support(f, h, inputs);
      const Vec3 half = s.half_widths(radius);
      Vec3 reached{};
      for (int n = 0; n < 20000; ++n) {
        const double x = normal(engine), y = normal(engine), z = normal(engine),
                     r = std::hypot(x, y, z) / radius;
        for (int c = 0; c < 3; ++c)
          reached[c] = std::max(
              reached[c], (s.matrix[3 * c] * x + s.matrix[3 * c + 1] * y + s.matrix[3 * c + 2] * z) / r);
      }
      for (int c = 0; c < 3; ++c) {
        EXPECT_LE(reached[c], half[c] * (1 + 1e-12));
        EXPECT_GT(reached[c], 0.995 * half[c]);
      }
    }
}

} // namespace
} // namespace spall::test
