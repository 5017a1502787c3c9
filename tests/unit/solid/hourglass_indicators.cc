#include "macro/solid/hourglass_indicators.h"

#include "tests/unit/points/clouds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace spall::test {
namespace {

constexpr int n = 9;

/// A lattice of n^3 points with all neighbours within 2.5 spacings.
struct Lattice {
  Points points;
  Ghosts ghosts;
  NeighborLists lists;
  std::vector<double> strain;

  explicit Lattice(double jitter = 0)
      : points(points_at(jittered_lattice(n, 1, jitter))), strain(points.owned) {
    lists.start = {0};
    for (std::uint32_t i = 0; i < points.owned; ++i) {
      for (std::uint32_t j = 0; j < points.owned; ++j) {
        double square = 0;
        for (int c = 0; c < 3; ++c) square += std::pow(points.position[i][c] - points.position[j][c], 2);
        if (square < 6.25) lists.index.push_back(j);
      }
      lists.start.push_back(static_cast<std::uint32_t>(lists.index.size()));
    }
  }
  std::array<int, 3> place(std::size_t i) const {
    return {static_cast<int>(i) % n, static_cast<int>(i) / n % n, static_cast<int>(i) / n / n};
  }
  void move(const std::function<Vec3(const Vec3&, const std::array<int, 3>&)>& map) {
    for (std::size_t i = 0; i < points.owned; ++i)
      points.position.set(i, map(points.initial_position[i], place(i)));
  }
  HourglassIndicators measure() const { return measure_hourglassing(points, ghosts, lists, strain); }
};

TEST(HourglassIndicatorsOf, VanishInAHomogeneousDeformation) {
  Lattice lattice;
  const Mat3 f = {1.3, 0.2, 0, -0.1, 0.8, 0.1, 0, 0.3, 1.1};
  lattice.points.relative.assign(lattice.points.owned, f);
  lattice.move([&](const Vec3& x, const auto&) {
    Vec3 y{};
    for (int i = 0; i < 9; ++i) y[i / 3] += f[i] * x[i % 3];
    return y;
  });
  lattice.strain.assign(lattice.points.owned, 0.7);
  const HourglassIndicators r = lattice.measure();
  for (const double value :
       {r.plastic_saw_tooth, r.position_saw_tooth, r.volume_mismatch, r.volume_alternation})
    EXPECT_NEAR(value, 0, 1e-12);
}

TEST(HourglassIndicatorsOf, ASawToothOfTheStrainIsMeasuredInProportion) {
  Lattice lattice;
  double last = 0;
  for (const double amplitude : {0.01, 0.02}) {
    for (std::size_t i = 0; i < lattice.points.owned; ++i) {
      const auto [a, b, c] = lattice.place(i);
      lattice.strain[i] = 0.3 + ((a + b + c) % 2 ? amplitude : -amplitude);
    }
    const double seen = lattice.measure().plastic_saw_tooth;
    EXPECT_GT(seen, amplitude); // because most neighbours have the opposite sign
    EXPECT_LT(seen, 2 * amplitude);
    if (last > 0) {
      EXPECT_NEAR(seen / last, 2, 1e-12);
    }
    last = seen;
  }
}

TEST(HourglassIndicatorsOf, AlternatingPositionsAreMeasuredAndCurvatureIsNot) {
  Lattice lattice;
  const double size = 0.02;
  lattice.move([&](const Vec3& x, const auto& at) {
    return Vec3{x[0] + (at[0] % 2 ? size : -size), x[1], x[2]};
  });
  const double rough = lattice.measure().position_saw_tooth;
  EXPECT_NEAR(rough, size, 0.5 * size);
  lattice.move([&](const Vec3& x, const auto&) { return Vec3{x[0] + size * x[0] * x[0] / 2, x[1], x[2]}; });
  EXPECT_LT(lattice.measure().position_saw_tooth, 0.02 * rough);
}

TEST(HourglassIndicatorsOf, CellsThatAlternateInVolumeAreMeasuredAndAGradientIsNot) {
  Lattice lattice;
  const double size = 0.1; // cells of sizes 1.1 and 0.9 alternate along x
  lattice.move([&](const Vec3& x, const auto& at) {
    return Vec3{x[0] + (at[0] % 2 ? 0.5 * size : -0.5 * size), x[1], x[2]};
  });
  const HourglassIndicators alternating = lattice.measure();
  EXPECT_NEAR(alternating.volume_alternation, size, 0.6 * size);
  EXPECT_NEAR(alternating.volume_mismatch, 0, 1e-3);
  const double slope = 0.02; // J = 1 + slope x
  for (std::size_t i = 0; i < lattice.points.owned; ++i)
    lattice.points.relative[i][0] = 1 + slope * lattice.points.initial_position[i][0];
  lattice.move([&](const Vec3& x, const auto&) { return Vec3{x[0] + slope * x[0] * x[0] / 2, x[1], x[2]}; });
  EXPECT_LT(lattice.measure().volume_alternation, 0.1 * slope);
}

TEST(HourglassIndicatorsOf, ADifferenceFromTheIntegratedVolumeIsMeasured) {
  for (const double jitter : {0.0, 0.15}) {
    Lattice lattice(jitter);
    lattice.move([](const Vec3& x, const auto&) { return Vec3{1.05 * x[0], x[1], x[2]}; });
    EXPECT_NEAR(lattice.measure().volume_mismatch, 0.05, 1e-12) << jitter;
  }
}

} // namespace
} // namespace spall::test
