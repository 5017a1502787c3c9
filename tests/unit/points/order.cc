#include "macro/points/order.h"

#include "tests/unit/points/clouds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace spall::test {
namespace {

double distance(const Vec3& a, const Vec3& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

TEST(HilbertOrder, IsAPermutation) {
  for (const std::size_t n : {0, 1, 2, 1000}) {
    auto order = hilbert_order(random_cloud(n, {-1, -1, -1}, {1, 2, 3}));
    ASSERT_EQ(order.size(), n);
    std::sort(order.begin(), order.end());
    for (std::size_t i = 0; i < n; ++i) EXPECT_EQ(order[i], i);
  }
}

TEST(HilbertOrder, PutsPointsThatAreNearInSpaceNearInMemory) {
  const auto positions = random_cloud(4096, {0, 0, 0}, {16, 16, 16});
  const auto order = hilbert_order(positions);
  double before = 0, after = 0;
  for (std::size_t i = 1; i < positions.size(); ++i) {
    before += distance(positions[i - 1], positions[i]);
    after += distance(positions[order[i - 1]], positions[order[i]]);
  }
  // The mean distance of random points in the cube is 0.66 edges = 10.6; along the curve it is about one
  // spacing.
  EXPECT_NEAR(before / 4095, 10.6, 0.5);
  EXPECT_LT(after / 4095, 1.5);
}

TEST(HilbertOrder, BlocksOfConsecutivePointsAreCompact) {
  const auto positions = jittered_lattice(16, 1, 0.1);
  const auto order = hilbert_order(positions);
  constexpr std::size_t block = 128;
  double extent = 0;
  for (std::size_t b = 0; b < positions.size(); b += block) {
    Vec3 low = positions[order[b]], high = low;
    for (std::size_t i = b; i < b + block; ++i)
      for (int c = 0; c < 3; ++c) {
        low[c] = std::min(low[c], positions[order[i]][c]);
        high[c] = std::max(high[c], positions[order[i]][c]);
      }
    extent += distance(low, high);
  }
  extent /= static_cast<double>(positions.size() / block);
  // The diagonal of a cube of 128 points is 8.7; that of a block of lattice rows would be 22.
  EXPECT_LT(extent, 12);
}

TEST(HilbertOrder, EqualPositionsKeepTheirOrder) {
  std::vector<std::uint32_t> expected(10);
  std::iota(expected.begin(), expected.end(), 0u);
  EXPECT_EQ(hilbert_order(std::vector<Vec3>(10, Vec3{1, 1, 1})), expected);
}

} // namespace
} // namespace spall::test
