#include "macro/shape/shape.h"

#include "tests/unit/points/clouds.h"
#include "tests/unit/shape/samples.h"

#include <gtest/gtest.h>

namespace spall::test {

namespace {

class EveryShape : public ::testing::TestWithParam<NamedShape> {
protected:
  const Shape& shape = GetParam().shape;
  SurfacePoint at(const Vec3& x) const { return surface(shape, x); }
  /// Random places in and around every body.
  static std::vector<Vec3> places(std::size_t n) {
    return random_cloud(n, {-0.07, -0.07, -0.23}, {0.07, 0.07, 0.09}, 5);
  }
};
INSTANTIATE_TEST_SUITE_P(Shapes, EveryShape, ::testing::ValuesIn(every_shape()),
                         [](const auto& instance) { return instance.param.name; });

TEST_P(EveryShape, TheDistanceIsLipschitzContinuous) {
  const auto here = places(3000), step = random_cloud(3000, {-0.02, -0.02, -0.02}, {0.02, 0.02, 0.02}, 6);
  for (std::size_t i = 0; i < here.size(); ++i)
    for (const double part : {1.0, 1e-3}) {
      const Vec3 there = here[i] + part * step[i];
      EXPECT_LE(std::abs(at(there).distance - at(here[i]).distance), part * norm(step[i]) + 1e-15);
    }
}

TEST_P(EveryShape, TheNormalIsTheGradientOfTheDistanceAndOfUnitLength) {
  const double h = 1e-7;
  int equal = 0, all = 0;
  for (const Vec3& x : places(3000)) {
    const Vec3 normal = at(x).normal;
    EXPECT_NEAR(norm(normal), 1, 1e-12);
    Vec3 gradient;
    for (int c = 0; c < 3; ++c) {
      Vec3 ahead = x, behind = x;
      ahead[c] += h, behind[c] -= h;
      gradient[c] = (at(ahead).distance - at(behind).distance) / (2 * h);
    }
    ++all, equal += norm(gradient - normal) < 1e-4;
  }
  // Places within h of a ridge are exceptions, because the nearest place on the surface jumps there.
  EXPECT_GE(equal, all - 3);
}

TEST_P(EveryShape, TheDistanceIsThatToTheNearestPlaceOfTheSurface) {
  const double spacing = 2e-3;
  const auto samples = surface_samples(shape, spacing);
  for (const Vec3& x : samples) EXPECT_NEAR(at(x).distance, 0, 1e-15);
  for (const Vec3& x : places(200)) {
    double nearest = 1;
    for (const Vec3& y : samples) nearest = std::min(nearest, norm(x - y));
    const double d = std::abs(at(x).distance);
    EXPECT_LE(d, nearest + 1e-15);
    EXPECT_GE(d, nearest - spacing);
    // The foot lies on the surface.
    EXPECT_NEAR(at(x - at(x).distance * at(x).normal).distance, 0, 1e-12);
  }
}

TEST_P(EveryShape, InsideIsWhereARayCrossesTheSurfaceAnOddNumberOfTimes) {
  int inside = 0;
  for (const Vec3& x : places(600)) {
    // Along -z in short steps the sign of the distance changes at every crossing, and is positive far away.
    const double step = 5e-4;
    int crossings = 0;
    double last = at(x).distance;
    if (std::abs(last) < step) continue;
    for (double z = x[2] - step; z > -0.25; z -= step) {
      const double now = at({x[0], x[1], z}).distance;
      crossings += (now < 0) != (last < 0);
      last = now;
    }
    EXPECT_GT(last, 0);
    EXPECT_EQ(crossings % 2 == 1, at(x).distance < 0);
    inside += at(x).distance < 0;
  }
  EXPECT_GT(inside, 10);
}

TEST_P(EveryShape, TheLowerBoundIsNeverAboveTheDistance) {
  std::visit(
      [](const auto& s) {
        for (const Vec3& x : random_cloud(5000, {-0.2, -0.2, -0.6}, {0.2, 0.2, 0.3}))
          EXPECT_LE(s.lower_bound(x), s.surface(x).distance + 1e-15);
      },
      shape);
}

TEST_P(EveryShape, TheExtentIsThatOfItsSurface) {
  const double spacing = 1e-3;
  const auto samples = surface_samples(shape, spacing);
  for (const Vec3& direction : random_cloud(40, {-1, -1, -1}, {1, 1, 1}, 3)) {
    const Vec3 n = unit(direction);
    double largest = -1;
    for (const Vec3& x : samples) largest = std::max(largest, dot(x, n));
    EXPECT_GE(extent(shape, n), largest - 1e-15);
    EXPECT_LE(extent(shape, n), largest + spacing);
  }
}

TEST_P(EveryShape, TheOutlineRunsFromTheTopToTheBottomOnTheSurface) {
  const auto line = outline(shape);
  EXPECT_NEAR(line.front().z, extent(shape, {0, 0, 1}), 1e-15);
  double low = 1;
  for (const ContourPoint& p : line) {
    low = std::min(low, p.z);
    if (p.r > 0) {
      EXPECT_NEAR(at({p.r, 0, p.z}).distance, 0, 1e-15);
    }
  }
  EXPECT_NEAR(low, -extent(shape, {0, 0, -1}), 1e-15);
}

TEST_P(EveryShape, VolumeCentreAndMomentsAreTheSumsOverItsInside) {
  const MassProperties p = mass_properties(shape);
  // Number of cells over the bounding box along each axis; a tree of triangles is slow.
  const int n = std::holds_alternative<ClosedSurface>(shape) ? 50 : 110;
  Vec3 low, size;
  for (int c = 0; c < 3; ++c) {
    Vec3 axis{};
    axis[c] = 1;
    low[c] = -extent(shape, -axis);
    size[c] = extent(shape, axis) - low[c];
  }
  double volume = 0, first = 0;
  Vec3 second{};
  const double cell = size[0] * size[1] * size[2] / (n * n * n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k) {
        const Vec3 x = {low[0] + size[0] * (i + 0.5) / n, low[1] + size[1] * (j + 0.5) / n,
                        low[2] + size[2] * (k + 0.5) / n};
        if (at(x).distance > 0) continue;
        volume += cell, first += cell * x[2];
        for (int c = 0; c < 3; ++c) second[c] += cell * (dot(x, x) - x[c] * x[c]);
      }
  EXPECT_NEAR(p.volume / volume, 1, 0.02);
  EXPECT_NEAR(p.centre[2], first / volume, 5e-4);
  for (int c = 0; c < 3; ++c) {
    const double about_centre = second[c] / volume - (c < 2 ? p.centre[2] * p.centre[2] : 0);
    EXPECT_NEAR(p.moments[c] / about_centre, 1, 0.04) << c;
  }
}

TEST(PlaneWall, DistanceIsTheHeight) {
  const SurfacePoint point = PlaneWall{}.surface({3, -4, -0.5});
  EXPECT_EQ(point.distance, -0.5);
  EXPECT_EQ(point.normal, (Vec3{0, 0, 1}));
  EXPECT_EQ(PlaneWall{}.extent({0, 0, 1}), 0);
  EXPECT_TRUE(std::isinf(PlaneWall{}.extent({1, 0, 0})));
}

TEST(Cylinder, TheWallOfAHoleIsOutside) {
  const Cylinder disc{.radius = 0.05, .height = 0.04, .bottom = 0, .hole = 0.01};
  const SurfacePoint in_hole = disc.surface({0, 0.006, 0.02});
  EXPECT_NEAR(in_hole.distance, 0.004, 1e-15);
  EXPECT_NEAR(in_hole.normal[1], -1, 1e-15);
  EXPECT_NEAR(disc.surface({0.013, 0, 0.02}).distance, -0.003, 1e-15);
}

} // namespace
} // namespace spall::test
