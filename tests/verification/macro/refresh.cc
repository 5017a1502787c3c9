// Tests of the refresh: of some regions only, and after more or fewer steps.

#include "tests/verification/macro/aluminium_bar.h"

#include <gtest/gtest.h>

namespace spall::test {
namespace {

/// Makes a block of 1000 points in eight blocks of memory.
std::unique_ptr<Solid> resting_block() {
  const J2 material = elastic();
  return make_solid(material, block(material, 10, 1e-3, 0.1), SymmetryPlanes{}, Numerics{}.solid());
}

TEST(Refresh, SkipsUndeformedRegionsButNotForEver) {
  const auto solid = resting_block();
  EXPECT_EQ(solid->refresh({.least_change = 1e-3, .most_skipped = 3}).rebuilt,
            1000u); // the first refresh rebuilds all points
  for (int repeat = 0; repeat < 2; ++repeat) {
    for (int n = 0; n < 3; ++n) {
      solid->update(1e-8, 0);
      EXPECT_EQ(solid->refresh({.least_change = 1e-3, .most_skipped = 3}).rebuilt, 0u);
    }
    EXPECT_EQ(solid->refresh({.least_change = 1e-3, .most_skipped = 3}).rebuilt, 1000u);
  }
  EXPECT_EQ(solid->refresh().rebuilt, 1000u); // without settings all points are rebuilt
}

TEST(Refresh, RebuildsTheRegionThatHasDeformed) {
  const auto solid = resting_block();
  const RefreshChoice choice{.least_change = 1e-3, .most_skipped = 100};
  solid->refresh(choice);
  Points& points = solid->points;
  const double dt = 1e-8;
  for (std::size_t i = 0; i < points.owned; ++i) {
    const double z = points.position.component[2][i];
    const double u = z > 7e-3 ? 0.1 * (z - 7e-3) : 0;
    points.velocity.set(i, {0, 0, u / dt});
    points.position.component[2][i] += u;
  }
  solid->update(dt, 0);
  const RefreshReport report = solid->refresh(choice);
  EXPECT_GT(report.rebuilt, 0u);
  EXPECT_LT(report.rebuilt, 1000u);
  for (std::size_t i = 0; i < points.owned; ++i) {
    if (points.position.component[2][i] > 8e-3) {
      EXPECT_EQ(points.relative[i], identity3) << i;
    }
  }
}

struct Refreshed {
  BarShape shape;
  double rebuilt; ///< mean fraction of the points that a refresh rebuilds
};
/// Runs a quarter of the aluminium bar with a refresh every twenty steps.
Refreshed refresh_some(double least_deformation) {
  const Bar s = aluminium_bar(6, 37, {"x", "y"});
  Simulation run =
      shoot(s, {.double_precision = false, .refresh_interval = 20, .least_deformation = least_deformation});
  until_rebound(run);
  EXPECT_LT(std::abs(run.energies.error()), 5e-3);
  return {shape_of(run), static_cast<double>(run.health.refreshed_points) /
                             static_cast<double>(run.health.refreshes * run.point_count())};
}

TEST(Refresh, OfDeformedRegionsOnlyGivesTheSameBarAtAPartOfTheWork) {
  const Refreshed all = refresh_some(0), some = refresh_some(2e-2);
  std::printf("rebuilt %.2f of the points; length %.5f after %.5f mm, foot %.4f after %.4f mm\n",
              some.rebuilt, some.shape.length * 1e3, all.shape.length * 1e3, some.shape.foot_diameter * 1e3,
              all.shape.foot_diameter * 1e3);
  EXPECT_EQ(all.rebuilt, 1);
  EXPECT_LT(some.rebuilt, 0.9);
  EXPECT_NEAR(some.shape.length, all.shape.length, 3e-3 * all.shape.length);
  EXPECT_NEAR(some.shape.foot_diameter, all.shape.foot_diameter, 3e-3 * all.shape.foot_diameter);
}

/// With NSNI the same bar has 0.704, 0.685 and 0.657 at 5, 10 and 20 steps.
TEST(Refresh, TheIntervalDoesNotChangeABarOfSubpointsAroundTheAxis) {
  const Bar bar = aluminium_bar(10, 62, {"axis"});
  for (const int interval : {5, 20}) {
    Simulation run =
        shoot(bar, {.scheme = Scheme::subpoint, .double_precision = false, .refresh_interval = interval});
    EXPECT_NEAR(shape_at_rebound(run, bar).length / bar.height, 0.7042, 5e-4) << interval;
  }
}

} // namespace
} // namespace spall::test
