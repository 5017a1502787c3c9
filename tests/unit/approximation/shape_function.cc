#include "tests/unit/approximation/clouds.h"

#include <gtest/gtest.h>

namespace spall::test {
namespace {

template<class T> class ShapeFunction : public ::testing::Test {};
using Precisions = ::testing::Types<float, double>;
TYPED_TEST_SUITE(ShapeFunction, Precisions);

/// Places to evaluate at: the centre of a cell, its faces, and a place without symmetry.
template<class T> std::vector<Vec<T>> places() {
  return {{0, 0, 0}, {T(0.25), 0, 0}, {0, T(-0.25), 0}, {T(0.1), T(0.07), T(-0.12)}};
}

template<class T> Moments<T> moments(Cloud<T>& cloud, const Vec<T>& at) {
  return evaluate_moments<Ball<CubicSpline>, false>(cloud, at);
}
template<class T> std::vector<T> shape_functions(const Cloud<T>& cloud, const Moments<T>& m) {
  std::vector<T> psi(cloud.size());
  LinearBasisOperator<T>{m}.values(cloud, psi.data());
  return psi;
}

TYPED_TEST(ShapeFunction, ReproducesConstantsAndLinears) {
  using T = TypeParam;
  for (auto& [name, cloud] : sound_clouds<T>())
    for (const auto& at : places<T>()) {
      const auto m = moments(cloud, at);
      if (m.regularized) continue; // the offset has moved the support of a corner away from its points
      const std::vector<T> psi = shape_functions(cloud, m);
      double one = 0, linear[3] = {};
      for (std::size_t j = 0; j < cloud.size(); ++j) {
        one += psi[j];
        for (int c = 0; c < 3; ++c) linear[c] += static_cast<double>(psi[j]) * cloud.xi[c][j];
      }
      EXPECT_NEAR(one, 1, round_off<T>) << name;
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(linear[c], at[c], round_off<T>) << name;
    }
}

TYPED_TEST(ShapeFunction, AreNotRegularisedAtMostPlaces) {
  using T = TypeParam;
  for (auto& [name, cloud] : sound_clouds<T>()) {
    EXPECT_FALSE(moments(cloud, Vec<T>{}).regularized) << name;
    if (!name.starts_with("bulk")) continue;
    for (const auto& at : places<T>()) EXPECT_FALSE(moments(cloud, at).regularized) << name;
  }
}

TYPED_TEST(ShapeFunction, ConstantsAreExactEvenWhereTheCloudIsSingular) {
  using T = TypeParam;
  for (auto& [name, cloud] : singular_clouds<T>())
    for (const auto& at : places<T>()) {
      const auto m = moments(cloud, at);
      EXPECT_TRUE(m.regularized) << name;
      double one = 0;
      for (const T psi : shape_functions(cloud, m)) one += psi;
      EXPECT_NEAR(one, 1, round_off<T>) << name;
    }
}

TYPED_TEST(ShapeFunction, PointsOutsideTheSupportTakeNoPart) {
  using T = TypeParam;
  auto cloud = lattice_cloud<T>(Part::bulk, 0.5, 0.2, {1, 0, 0, 0, 1, 0, 0, 0, 1}, 1);
  const auto before = moments(cloud, Vec<T>{});
  cloud.add(999, T(0.9), T(0.9), T(0));
  cloud.add(998, T(30), T(0), T(0));
  const auto after = moments(cloud, Vec<T>{});
  const std::vector<T> psi = shape_functions(cloud, after);
  EXPECT_EQ(psi[cloud.size() - 1], T(0));
  EXPECT_EQ(psi[cloud.size() - 2], T(0));
  EXPECT_NEAR(before.mu0, after.mu0, round_off<T>);
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(before.inverse[i], after.inverse[i], round_off<T>);
}

TYPED_TEST(ShapeFunction, AnEmptyCloudGivesNothing) {
  using T = TypeParam;
  Cloud<T> cloud;
  const auto m = moments(cloud, Vec<T>{});
  EXPECT_EQ(m.mu0, T(0));
  for (const T i : m.inverse) EXPECT_EQ(i, T(0));
}

} // namespace
} // namespace spall::test
