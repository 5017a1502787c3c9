#include "macro/scene/fill.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <set>

namespace spall::test {
namespace {

constexpr Cylinder cylinder{.radius = 0.05, .height = 0.08, .bottom = 0.01};
constexpr double density = 2700;
constexpr Boundary boundaries[] = {Boundary::centred, Boundary::on_surface};

Points fill(int rings, int layers, Boundary boundary, const SymmetryPlanes& planes = {}) {
  return fill_cylinder(cylinder, rings, layers, boundary, planes, density);
}

/// Position to a nanometre and volume to a part in 10^9, for comparing sets of points.
using Key = std::array<long long, 4>;
Key key(const Vec3& x, double volume) {
  const double cell = std::numbers::pi * cylinder.radius * cylinder.radius * cylinder.height;
  return {std::llround(x[0] * 1e9), std::llround(x[1] * 1e9), std::llround(x[2] * 1e9),
          std::llround(volume / cell * 1e9)};
}
std::multiset<Key> keys(const Points& points) {
  std::multiset<Key> all;
  for (std::size_t i = 0; i < points.owned; ++i) all.insert(key(points.position[i], points.volume[i]));
  return all;
}

TEST(FillCylinder, VolumesAndMassesAddUpExactly) {
  const double whole = std::numbers::pi * cylinder.radius * cylinder.radius * cylinder.height;
  for (const Boundary boundary : boundaries)
    for (const auto& [rings, layers] : {std::pair(1, 2), {2, 3}, {5, 9}, {11, 4}})
      for (const SymmetryPlanes planes : {SymmetryPlanes{}, {{true, false, false}}, {{true, true, false}}}) {
        const Points points = fill(rings, layers, boundary, planes);
        double volume = 0, mass = 0;
        for (std::size_t i = 0; i < points.owned; ++i) volume += points.volume[i], mass += points.mass[i];
        const double part = whole / planes.multiplicity();
        EXPECT_NEAR(volume, part, 1e-12 * part) << rings << " rings, " << layers << " layers";
        EXPECT_NEAR(mass, density * part, 1e-12 * density * part);
      }
}

TEST(FillCylinder, IsSymmetricAboutBothPlanesWithNoPointOnThem) {
  for (const Boundary boundary : boundaries) {
    const Points points = fill(6, 5, boundary);
    const auto all = keys(points);
    for (std::size_t i = 0; i < points.owned; ++i) {
      const Vec3 x = points.position[i];
      EXPECT_EQ(all.count(key({-x[0], x[1], x[2]}, points.volume[i])), 1u);
      EXPECT_EQ(all.count(key({x[0], -x[1], x[2]}, points.volume[i])), 1u);
      EXPECT_GT(std::min(std::abs(x[0]), std::abs(x[1])), 0.1 * points.spacing[i]);
    }
  }
}

TEST(FillCylinder, JitteredPointsStayInTheirCells) {
  for (const Boundary boundary : boundaries) {
    const SymmetryPlanes quarter{{true, true, false}};
    const Points regular = fill(6, 5, boundary, quarter);
    const Points jittered = fill_cylinder(cylinder, 6, 5, boundary, quarter, density, {.amount = 0.9});
    ASSERT_EQ(jittered.owned, regular.owned);
    double mass = 0, moved = 0, low = 1, radius = 0;
    for (std::size_t i = 0; i < jittered.owned; ++i) {
      const Vec3 x = jittered.position[i];
      EXPECT_GT(std::min(x[0], x[1]), 0); // still on their side of the planes
      mass += jittered.mass[i];
      low = std::min(low, x[2]);
      radius = std::max(radius, std::hypot(x[0], x[1]));
      // The order along the curve differs, so the nearest regular point is looked for: at most half a cell
      // off.
      double nearest = 1;
      for (std::size_t j = 0; j < regular.owned; ++j) {
        const Vec3 y = regular.position[j];
        nearest = std::min(nearest, std::hypot(x[0] - y[0], x[1] - y[1], x[2] - y[2]));
      }
      EXPECT_LT(nearest, 0.5 * std::sqrt(3.0) * 1.2 * regular.spacing[i]);
      moved = std::max(moved, nearest);
    }
    EXPECT_NEAR(mass, density * std::numbers::pi * 0.05 * 0.05 * 0.08 / 4, 1e-12);
    EXPECT_GT(moved, 0.3 * regular.spacing[0]);
    if (boundary == Boundary::on_surface) {
      EXPECT_DOUBLE_EQ(low, cylinder.bottom);
      EXPECT_NEAR(radius, cylinder.radius, 1e-15);
    }
  }
}

TEST(FillCylinder, TheSeedDecidesTheJitter) {
  const auto x = [](int seed) {
    return fill_cylinder(cylinder, 3, 3, Boundary::centred, {}, density, {.amount = 0.5, .seed = seed})
        .position;
  };
  EXPECT_EQ(x(7).component, x(7).component);
  EXPECT_NE(x(7).component, x(8).component);
}

TEST(FillCylinder, AQuarterIsThatPartOfTheWhole) {
  for (const Boundary boundary : boundaries) {
    const Points full = fill(6, 5, boundary), quarter = fill(6, 5, boundary, {{true, true, false}});
    ASSERT_EQ(4 * quarter.owned, full.owned);
    const auto all = keys(full);
    for (const Key& k : keys(quarter)) {
      EXPECT_EQ(all.count(k), 1u);
      EXPECT_GT(k[0], 0);
      EXPECT_GT(k[1], 0);
    }
    EXPECT_EQ(quarter.spacing[0], full.spacing[0]);
  }
}

TEST(FillCylinder, PointsLieOnTheSurfaceOrHalfACellInside) {
  const auto extent = [](const Points& points) {
    double radius = 0, low = 1e9, high = 0;
    for (std::size_t i = 0; i < points.owned; ++i) {
      const Vec3 x = points.position[i];
      radius = std::max(radius, std::hypot(x[0], x[1])), low = std::min(low, x[2]),
      high = std::max(high, x[2]);
    }
    return Vec3{radius, low, high};
  };
  const double bottom = cylinder.bottom, top = bottom + cylinder.height;
  const Vec3 on = extent(fill(5, 9, Boundary::on_surface)), in = extent(fill(5, 8, Boundary::centred));
  EXPECT_NEAR(on[0], cylinder.radius, 1e-15);
  EXPECT_NEAR(on[1], bottom, 1e-15);
  EXPECT_NEAR(on[2], top, 1e-15);
  EXPECT_NEAR(in[0], 0.9 * cylinder.radius, 1e-15);
  EXPECT_NEAR(in[1], bottom + cylinder.height / 16, 1e-15);
  EXPECT_NEAR(in[2], top - cylinder.height / 16, 1e-15);
}

TEST(FillCylinder, CentreOfMassIsOnTheAxisAtHalfHeight) {
  for (const Boundary boundary : boundaries) {
    const Points points = fill(5, 6, boundary);
    Vec3 moment{};
    double mass = 0;
    for (std::size_t i = 0; i < points.owned; ++i) {
      mass += points.mass[i];
      // Cells cut by the surface are half cells: their point is on their face, which is what is being
      // integrated.
      for (int c = 0; c < 3; ++c) moment[c] += points.mass[i] * points.position[i][c];
    }
    EXPECT_NEAR(moment[0] / mass, 0, 1e-15);
    EXPECT_NEAR(moment[1] / mass, 0, 1e-15);
    EXPECT_NEAR(moment[2] / mass, cylinder.bottom + 0.5 * cylinder.height, 1e-15);
  }
}

TEST(FillCylinder, CellsAreNearlyCubesOfTheSpacing) {
  const Points points = fill(10, 16, Boundary::centred); // height / layers = radius / rings = 5 mm
  EXPECT_NEAR(points.spacing[0], 5e-3, 1e-15);
  for (std::size_t i = 0; i < points.owned; ++i) {
    EXPECT_EQ(points.spacing[i], points.spacing[0]);
    EXPECT_NEAR(points.volume[i] / std::pow(5e-3, 3), 1, 0.25);
  }
}

TEST(FillCylinder, StartsAtRestAndUndeformed) {
  const Points points = fill(3, 4, Boundary::centred);
  for (std::size_t i = 0; i < points.owned; ++i) {
    EXPECT_EQ(points.initial_position[i], points.position[i]);
    EXPECT_EQ(points.velocity[i], Vec3{});
    EXPECT_EQ(points.deformation(i), identity3);
    EXPECT_EQ(points.cauchy(i), Sym3{});
  }
}

} // namespace
} // namespace spall::test
