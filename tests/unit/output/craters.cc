#include "macro/output/craters.h"

#include "tests/support/small_bar.h"

#include <gtest/gtest.h>

#include <numbers>

namespace spall::test {
namespace {

constexpr double height = 8e-3, radius = 4e-3; // dimensions of the small bar, whose cells are cubes of 1 mm
constexpr double loose = 1e-3; // opening of a crack that is counted in no test but those that say so

/// Finds the craters of the bar after displacement(X) of its points, which stay connected.
template<class Displacement>
Craters craters_after(const std::vector<std::string>& symmetry, const Displacement& displacement,
                      double jitter = 0, Missing missing = Missing::fragments_and_moved,
                      double opening = loose) {
  Bar bar = small_bar(symmetry);
  bar.filling.jitter.amount = jitter;
  const auto solid = bar.solid();
  Points& points = solid->points;
  Fragments whole;
  whole.of_point.assign(points.owned, 0);
  for (std::size_t i = 0; i < points.owned; ++i) {
    const Vec3 x = points.initial_position[i], u = displacement(x);
    points.position.set(i, {x[0] + u[0], x[1] + u[1], x[2] + u[2]});
  }
  return measure_craters(*solid, whole, 0, height, radius, opening, missing);
}

/// Displacement in which two of four rings leave the front and three the back; changes inside must not count.
Vec3 spalling(const Vec3& x) {
  const double r = std::hypot(x[0], x[1]);
  if (r < 2e-3 && x[2] < 1e-3) return {0, 0, -0.51e-3};
  if (r < 3e-3 && x[2] > 6e-3) return {0.3e-3, 0, 0.5e-3};
  if (x[2] > 2e-3 && x[2] < 5e-3) return {0, 5e-3, 0};
  return {};
}

TEST(Craters, AMetalThatIsDentedHasNone) {
  const Craters craters = craters_after({}, spalling, 0, Missing::fragments);
  EXPECT_EQ(craters.front.mean_diameter, 0);
  EXPECT_EQ(craters.back.deepest, 0);
}

TEST(Craters, AnUntouchedSlabHasNone) {
  const Craters craters = craters_after({}, [](const Vec3&) { return Vec3{}; });
  for (const Crater* crater : {&craters.front, &craters.back}) {
    EXPECT_EQ(crater->mean_diameter, 0);
    EXPECT_EQ(crater->largest_diameter, 0);
    EXPECT_EQ(crater->deepest, 0);
  }
}

TEST(Craters, ASlabThatFliesOnAsAWholeHasNone) {
  const Craters craters = craters_after({}, [](const Vec3&) { return Vec3{0, 0, 20e-3}; });
  EXPECT_EQ(craters.back.mean_diameter, 0);
}

TEST(Craters, HaveTheDiameterAndDepthOfTheMissingPart) {
  // The points of a ring have gaps between them, so the outline of nearest places varies by some tenths of a
  // cell.
  for (const std::vector<std::string>& symmetry : {std::vector<std::string>{}, {"x"}, {"x", "y"}, {"axis"}}) {
    const Craters craters = craters_after(symmetry, spalling);
    EXPECT_NEAR(craters.front.mean_diameter, 4e-3, 0.2e-3);
    EXPECT_NEAR(craters.back.mean_diameter, 6e-3, 0.2e-3);
    EXPECT_NEAR(craters.front.deepest, 1e-3, 1e-9);
    EXPECT_NEAR(craters.back.deepest, 2e-3, 1e-9);
    EXPECT_NEAR(craters.front.depth.front(), 1e-3, 1e-9);
    EXPECT_GE(craters.front.largest_diameter, craters.front.mean_diameter * (1 - 1e-12));
  }
}

TEST(Craters, AreTheSameWhateverSymmetryPlanesAreUsed) {
  const Craters whole = craters_after({}, spalling), quarter = craters_after({"x", "y"}, spalling);
  ASSERT_EQ(whole.front.outline.size(), quarter.front.outline.size());
  for (std::size_t s = 0; s < whole.front.outline.size(); ++s) {
    EXPECT_NEAR(whole.front.outline[s], quarter.front.outline[s], 0.1e-3);
    EXPECT_NEAR(whole.back.outline[s], quarter.back.outline[s], 0.1e-3);
  }
}

TEST(Craters, OfAJitteredLayoutAreThoseOfTheRegularOne) {
  const Craters craters = craters_after({}, spalling, 0.3);
  EXPECT_NEAR(craters.front.mean_diameter, 4e-3, 0.6e-3);
  EXPECT_NEAR(craters.back.mean_diameter, 6e-3, 0.6e-3);
}

TEST(Craters, AHoleIsAsDeepFromBothFaces) {
  const Craters craters = craters_after({}, [](const Vec3& x) {
    return Vec3{0, 0, std::hypot(x[0], x[1]) < 1e-3 ? 30e-3 : 0};
  });
  EXPECT_NEAR(craters.front.mean_diameter, 2e-3, 0.25e-3);
  EXPECT_NEAR(craters.back.mean_diameter, 2e-3, 0.25e-3);
  EXPECT_NEAR(craters.front.deepest, height, 1e-9);
  EXPECT_NEAR(craters.back.deepest, height, 1e-9);
}

/// Displacement that lifts the two outermost layers of both faces by less than half a cell within rings.
Vec3 lifted(const Vec3& x) {
  const double r = std::hypot(x[0], x[1]);
  return {0, 0, x[2] < 2e-3 && r < 2e-3 ? -0.3e-3 : x[2] > 6e-3 && r < 3e-3 ? 0.25e-3 : 0};
}

/// Both faces tell which side of an open crack is loose, and a crack that is not open enough parts nothing.
TEST(Craters, WhatIsAboveAnOpenCrackIsMissing) {
  for (const std::vector<std::string>& symmetry : {std::vector<std::string>{}, {"x", "y"}, {"axis"}}) {
    const Craters craters = craters_after(symmetry, lifted, 0, Missing::fragments_and_moved, 0.2e-3);
    EXPECT_NEAR(craters.front.mean_diameter, 4e-3, 0.2e-3);
    EXPECT_NEAR(craters.back.mean_diameter, 6e-3, 0.2e-3);
    EXPECT_NEAR(craters.front.deepest, 2e-3, 1e-9);
    EXPECT_NEAR(craters.back.deepest, 2e-3, 1e-9);
  }
  EXPECT_EQ(craters_after({}, lifted, 0, Missing::fragments_and_moved, 0.26e-3).back.mean_diameter, 0);
  EXPECT_EQ(craters_after({}, lifted, 0, Missing::fragments, 0.2e-3).front.mean_diameter, 0);
}

/// A slab that bends lifts its columns as they are.
TEST(Craters, ASlabThatBendsHasNone) {
  const Craters craters = craters_after(
      {},
      [](const Vec3& x) {
        return Vec3{0, 0, 30 * (x[0] * x[0] + x[1] * x[1])};
      },
      0, Missing::fragments_and_moved, 0.1e-3);
  EXPECT_EQ(craters.front.mean_diameter, 0);
  EXPECT_EQ(craters.back.mean_diameter, 0);
}

/// Fills the box |x|, |y| < half, 0 < z < height, outside |x|, |y| < inner, with cubes of edge `edge`.
void add_lattice(std::vector<Vec3>& centres, std::vector<double>& edges, double edge, double inner,
                 double half) {
  const int n = static_cast<int>(std::lround(2 * half / edge)), layers = std::lround(height / edge);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < layers; ++k) {
        const Vec3 x = {edge * (i + 0.5) - half, edge * (j + 0.5) - half, edge * (k + 0.5)};
        if (std::max(std::abs(x[0]), std::abs(x[1])) < inner) continue;
        centres.push_back(x);
        edges.push_back(edge);
      }
}

TEST(Craters, EachPointCountsWithItsOwnCellWhereTheSpacingIsGraded) {
  std::vector<Vec3> centres;
  std::vector<double> edges;
  add_lattice(centres, edges, 0.5e-3, 0, 2e-3);
  add_lattice(centres, edges, 1e-3, 2e-3, 6e-3);
  Points points;
  points.resize(centres.size());
  for (std::size_t i = 0; i < centres.size(); ++i) {
    points.position.set(i, centres[i]), points.initial_position.set(i, centres[i]);
    points.spacing[i] = edges[i], points.volume[i] = std::pow(edges[i], 3);
    points.mass[i] = 2400 * points.volume[i];
  }
  const auto solid = make_solid(aluminium(), std::move(points), {}, {});
  Fragments broken;
  // The crater is a square pit of 6 mm, 2 mm deep, with one half in either spacing.
  for (const Vec3& x : centres)
    broken.of_point.push_back(std::max(std::abs(x[0]), std::abs(x[1])) < 3e-3 && x[2] < 2e-3);
  const Craters craters = measure_craters(*solid, broken, 0, height, 6e-3, loose);
  EXPECT_NEAR(craters.front.mean_diameter, std::sqrt(4 * 36e-6 / std::numbers::pi), 0.05e-3);
  EXPECT_NEAR(craters.front.largest_diameter, 6e-3 * std::numbers::sqrt2, 0.4e-3);
  EXPECT_NEAR(craters.front.deepest, 2e-3, 1e-9);
  EXPECT_EQ(craters.back.mean_diameter, 0);
}

} // namespace
} // namespace spall::test
