#include "macro/shape/fill_revolution.h"

#include <gtest/gtest.h>

#include <cmath>

namespace spall::test {
namespace {

/// A shell between two paraboloids with a solid tip: outer radius sqrt(-z), with a cavity from z = -0.3 on.
const Sections shell{.outer = [](double z) { return std::sqrt(-z); },
                     .inner = [](double z) { return z < -0.3 ? 0.8 * std::sqrt(-z - 0.3) : 0.0; },
                     .kinks = {-1, -0.3, 0},
                     .breaks = {}};
/// Volumes and first moments of the paraboloids: pi a b^2 / 2 with a^2 = slope, centre at two thirds.
constexpr double pi = std::numbers::pi, outer = pi / 2, inner = pi * 0.64 * 0.49 / 2;
constexpr double moment = outer * (-2.0 / 3) - inner * (-0.3 - 0.7 * 2 / 3);

TEST(FillRevolution, VolumeMassAndCentreOfMassAreExact) {
  for (const double spacing : {0.2, 0.05})
    for (const SymmetryPlanes planes : {SymmetryPlanes{}, {{false, true, false}}, {{true, true, false}}}) {
      const Points points = fill_revolution(shell, 2, spacing, planes, 3);
      double volume = 0, mass = 0, first = 0;
      for (std::size_t i = 0; i < points.owned; ++i) {
        volume += points.volume[i], mass += points.mass[i];
        first += points.volume[i] * points.position[i][2];
      }
      const double part = 1 / planes.multiplicity();
      EXPECT_NEAR(volume, part * (outer - inner), 1e-12);
      EXPECT_NEAR(mass, 3 * volume, 1e-12);
      EXPECT_NEAR(first, part * moment, 1e-12);
    }
}

TEST(FillRevolution, PointsLieInTheWallAndOffTheAxisAndThePlanes) {
  const Points points = fill_revolution(shell, 2, 0.05, {}, 1);
  EXPECT_GT(points.owned, 1000u);
  for (std::size_t i = 0; i < points.owned; ++i) {
    const Vec3 x = points.position[i];
    const double r = std::hypot(x[0], x[1]);
    EXPECT_LT(r, shell.outer(x[2]));
    EXPECT_GT(r, shell.inner(x[2]));
    EXPECT_GT(std::abs(x[0]), 1e-4);
    EXPECT_GT(std::abs(x[1]), 1e-4);
    EXPECT_EQ(points.initial_position[i], x);
  }
}

TEST(FillRevolution, AQuarterIsAQuarterOfTheWhole) {
  const Points whole = fill_revolution(shell, 2, 0.1, {}, 1),
               quarter = fill_revolution(shell, 2, 0.1, {{true, true, false}}, 1);
  EXPECT_EQ(4 * quarter.owned, whole.owned);
}

TEST(FillRevolution, AThinWallHasTheRingsAskedFor) {
  const Sections tube{.outer = [](double) { return 1.0; },
                      .inner = [](double) { return 0.98; },
                      .kinks = {0, 1},
                      .breaks = {}};
  for (const int rings : {1, 2, 3}) {
    const Points points = fill_revolution(tube, rings, 0.1, {}, 1);
    // There are 10 layers with 60 or 64 points on each ring.
    EXPECT_NEAR(static_cast<double>(points.owned), 10 * rings * 62, 10 * rings * 2 + 1);
  }
}

} // namespace
} // namespace spall::test
