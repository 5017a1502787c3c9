#include "macro/points/neighbor_search.h"

#include "macro/points/ghosts.h"
#include "tests/unit/points/clouds.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace spall::test {
namespace {

std::vector<std::uint32_t> brute_force(const Points& points, const Vec3& centre, const Vec3& half) {
  std::vector<std::uint32_t> found;
  for (std::size_t i = 0; i < points.position.component[0].size(); ++i) {
    bool inside = true;
    for (int c = 0; c < 3; ++c) inside = inside && std::abs(points.position[i][c] - centre[c]) <= half[c];
    if (inside) found.push_back(static_cast<std::uint32_t>(i));
  }
  return found;
}

/// Compares the search with brute force for boxes about every point. The search may visit points outside the
/// box up to the size of a grid cell; these are filtered by their offsets.
void expect_same(const Points& points, double cell, const Vec3& half) {
  NeighborSearch search;
  search.rebuild(points, cell);
  for (std::size_t i = 0; i < points.owned; ++i) {
    const Vec3 centre = points.position[i];
    std::vector<std::uint32_t> found;
    search.for_each_in_box(centre, half, [&](std::uint32_t j, double dx, double dy, double dz) {
      EXPECT_EQ(dx, points.position[j][0] - centre[0]);
      EXPECT_EQ(dy, points.position[j][1] - centre[1]);
      EXPECT_EQ(dz, points.position[j][2] - centre[2]);
      if (std::abs(dx) <= half[0] && std::abs(dy) <= half[1] && std::abs(dz) <= half[2]) found.push_back(j);
    });
    std::sort(found.begin(), found.end());
    ASSERT_EQ(found, brute_force(points, centre, half)) << "around point " << i;
  }
}

TEST(NeighborSearch, FindsWhatBruteForceFinds) {
  const Points points = points_at(random_cloud(600, {-1, 2, -5}, {4, 5, -1}));
  for (const double cell : {0.2, 0.9, 7.0}) expect_same(points, cell, {0.8, 0.5, 1.3});
}

TEST(NeighborSearch, FindsGhostsToo) {
  Points points = points_at(random_cloud(400, {0, 0, 0}, {3, 3, 3}));
  Ghosts ghosts(SymmetryPlanes{{true, true, false}});
  ghosts.rebuild(points, {1, 1, 1});
  ASSERT_GT(ghosts.size(), 0u);
  expect_same(points, 0.5, {1, 1, 1});
}

TEST(NeighborSearch, FragmentsThatHaveFlownFarCostNeitherMemoryNorNeighbors) {
  auto positions = random_cloud(300, {0, 0, 0}, {2, 2, 2});
  const auto fragments = random_cloud(30, {-1e6, -1e6, -1e6}, {1e6, 1e6, 1e6}, 3);
  positions.insert(positions.end(), fragments.begin(), fragments.end());
  expect_same(points_at(positions), 0.3, {0.6, 0.6, 0.6});
}

TEST(NeighborSearch, PointsInAPlaneOnALineOrAtOnePlace) {
  expect_same(points_at(random_cloud(200, {0, 0, 1}, {5, 5, 1})), 0.5, {1, 1, 1});
  expect_same(points_at(random_cloud(200, {0, 2, 1}, {5, 2, 1})), 0.5, {1, 1, 1});
  expect_same(points_at(std::vector<Vec3>(20, Vec3{1, 2, 3})), 0.5, {1, 1, 1});
  expect_same(points_at({{7, 7, 7}}), 0.5, {1, 1, 1});
}

TEST(NeighborSearch, VisitsEveryPointOfTheBoxOnceAndFewOutside) {
  const Points points = points_at(random_cloud(5000, {0, 0, 0}, {10, 10, 10}));
  NeighborSearch search;
  search.rebuild(points, 0.5);
  const Vec3 centre = {5, 5, 5}, half = {1, 1, 1};
  std::vector<std::uint32_t> visited;
  search.for_each_in_box(centre, half,
                         [&](std::uint32_t j, double, double, double) { visited.push_back(j); });
  const std::size_t count = visited.size();
  std::sort(visited.begin(), visited.end());
  EXPECT_EQ(std::unique(visited.begin(), visited.end()), visited.end());
  // The search visits at most one layer of cells too many on each side: (2 + 2 * 0.5)^3 of the volume 1000.
  EXPECT_LT(count, 1.4 * 27 * 5);
}

TEST(NeighborSearch, TheOrderOfVisitsDependsOnPositionsOnly) {
  const Points points = points_at(random_cloud(500, {0, 0, 0}, {3, 3, 3}));
  NeighborSearch fresh, used;
  used.rebuild(points_at(random_cloud(900, {-5, 0, 0}, {3, 9, 3}, 8)), 0.1);
  fresh.rebuild(points, 0.4);
  used.rebuild(points, 0.4);
  std::vector<std::uint32_t> a, b;
  fresh.for_each_in_box({1, 1, 1}, {1, 1, 1},
                        [&](std::uint32_t j, double, double, double) { a.push_back(j); });
  used.for_each_in_box({1, 1, 1}, {1, 1, 1},
                       [&](std::uint32_t j, double, double, double) { b.push_back(j); });
  EXPECT_EQ(a, b);
}

} // namespace
} // namespace spall::test
