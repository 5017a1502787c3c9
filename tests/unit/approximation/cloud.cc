#include "macro/approximation/reproducing_kernel.h"

#include <gtest/gtest.h>

#include <random>

namespace spall::test {
namespace {

/// Makes a cloud of random offsets in the cube [-1, 1]^3; the k-th point has the index 7 k.
template<class T> Cloud<T> random_offsets(std::uint32_t count) {
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> place(-1, 1);
  Cloud<T> cloud;
  for (std::uint32_t k = 0; k < count; ++k)
    cloud.add(7 * k, T(place(engine)), T(place(engine)), T(place(engine)));
  return cloud;
}

template<class T> Vec3 point(const Cloud<T>& cloud, std::size_t j) {
  return {static_cast<double>(cloud.xi[0][j]), static_cast<double>(cloud.xi[1][j]),
          static_cast<double>(cloud.xi[2][j])};
}

/// Compares the points that are kept, and their order, with those inside.
template<bool Box, class T> void expect_points_inside(double reach) {
  const Cloud<T> all = random_offsets<T>(300);
  Cloud<T> kept = all;
  kept.template keep_within<Box>(T(reach));
  std::size_t k = 0;
  for (std::size_t j = 0; j < all.size(); ++j) {
    const Vec3 x = point(all, j);
    if (!(Box ? largest_component(x) < reach : norm(x) < reach)) continue;
    ASSERT_LT(k, kept.size());
    EXPECT_EQ(kept.index[k], 7 * j);
    EXPECT_EQ(norm(point(kept, k) - x), 0);
    ++k;
  }
  EXPECT_EQ(kept.size(), k);
  EXPECT_GT(k, 30u);
  EXPECT_LT(k, 270u);
}

TEST(Cloud, KeepsThePointsInsideInTheirOrder) {
  expect_points_inside<false, float>(0.8);
  expect_points_inside<false, double>(0.8);
  expect_points_inside<true, float>(0.7);
  expect_points_inside<true, double>(0.7);
}

TEST(Cloud, OffsetsBecomeCoordinatesOfTheSupport) {
  const Mat3 inverse = {2, 0.3, -0.1, 0, 1.5, 0.2, 0.4, 0, 1};
  const Cloud<double> offsets = random_offsets<double>(50);
  Cloud<double> cloud = offsets;
  cloud.transform(inverse);
  ASSERT_EQ(cloud.size(), 50u);
  for (std::size_t j = 0; j < cloud.size(); ++j)
    EXPECT_LT(norm(point(cloud, j) - times(inverse, point(offsets, j))), 1e-15);
}

TEST(Cloud, IsFilledAgainWithoutTraceOfWhatItHeld) {
  Cloud<float> cloud = random_offsets<float>(100);
  cloud.clear();
  EXPECT_EQ(cloud.size(), 0u);
  cloud.add(3, 0.1f, 0.2f, 0.3f);
  ASSERT_EQ(cloud.size(), 1u);
  const auto m = evaluate_moments<Ball<CubicSpline>, false>(cloud);
  EXPECT_NEAR(m.origin[0], 0.1f, 1e-6f);
  EXPECT_NEAR(m.origin[2], 0.3f, 1e-6f);
}

} // namespace
} // namespace spall::test
