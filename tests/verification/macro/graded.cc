// Tests of bodies whose spacing grows with the distance from the axis: properties of uniform spacings must
// hold across the transition, where layers of neighbouring rings do not meet.

#include "tests/verification/macro/bodies.h"

#include <gtest/gtest.h>

#include <map>

namespace spall::test {
namespace {

constexpr Cylinder disc{.radius = 0.18, .height = 0.036};
constexpr double fine = 2e-3, coarse = 6e-3, fine_radius = 0.04;

Filling graded(double growth) {
  return {.grading = {
              .fine_spacing = fine, .fine_radius = fine_radius, .coarse_spacing = coarse, .growth = growth}};
}

TEST(GradedSpacing, LinearVelocitiesHaveTheirGradientEverywhere) {
  const J2 material = elastic();
  const Mat3 gradient = {3, -1, 2, 0.5, -2, 1, 4, 1.5, -0.5};
  for (const double jitter : {0.0, 0.5})
    for (const Scheme scheme : {Scheme::nsni, Scheme::subpoint}) {
      Filling filling = graded(1.2);
      filling.jitter.amount = jitter;
      Points points = fill_cylinder({.radius = 0.08, .height = 0.012}, filling, {}, material.density);
      set_velocity(points, [&](const Vec3& x) {
        Vec3 v{};
        for (int r = 0; r < 3; ++r)
          for (int c = 0; c < 3; ++c) v[r] += gradient[3 * r + c] * x[c];
        return v;
      });
      const auto solid =
          make_solid(material, std::move(points), SymmetryPlanes{}, Numerics{.scheme = scheme}.solid());
      const RefreshReport report = solid->refresh();
      EXPECT_EQ(report.regularized, 0u);
      EXPECT_EQ(report.isolated, 0u);
      const double dt = 1e-6;
      solid->update(dt, 0);
      for (std::size_t i = 0; i < solid->points.owned; ++i)
        for (int c = 0; c < 9; ++c)
          ASSERT_NEAR((solid->points.relative[i][c] - identity3[c]) / dt, gradient[c], 1e-8) << i;
    }
}

/// Returns the mean radial velocity of the rings of a disc by radius, after a pulse around r = 25 mm has
/// split and both halves have passed from the fine to the coarse region (the inner one through the axis).
std::map<double, double> after_crossing(const Filling& filling) {
  const J2 material = elastic(78.6e9, 0);
  const SymmetryPlanes round{
      .axis = true}; // rotational symmetry is cheap and has the same gradients as three dimensions
  Points points = fill_cylinder(disc, filling, round, material.density);
  set_velocity(points, [](const Vec3& x) {
    const double r = std::hypot(x[0], x[1]), v = 1e-2 * std::exp(-std::pow((r - 0.025) / 0.015, 2));
    return Vec3{v * x[0] / r, v * x[1] / r, 0};
  });
  const SolidInputs inputs = Numerics{.double_precision = false}.solid();
  Simulation run(bodies_of(make_solid(material, std::move(points), round, inputs)), ContactInputs{},
                 TimeInputs{.end_time = 1, .verify_every = 0}, inputs.integration);
  const double speed = std::sqrt(material.youngs_modulus / material.density);
  while (run.time < 0.115 / speed) run.advance();
  const Points& p = run.bodies.solids[0]->points;
  std::map<double, std::pair<double, int>> sums;
  for (std::size_t i = 0; i < p.owned; ++i) {
    const Vec3 x = p.initial_position[i], v = p.velocity[i];
    const double r = std::hypot(x[0], x[1]);
    auto& [sum, count] = sums[std::round(r * 1e7) * 1e-7];
    sum += (x[0] * v[0] + x[1] * v[1]) / r, ++count;
  }
  std::map<double, double> rings;
  for (const auto& [r, sum] : sums) rings[r] = sum.first / sum.second;
  return rings;
}

TEST(GradedSpacing, AWaveThatLeavesTheFineRegionIsHardlyReflected) {
  const auto reference =
      after_crossing({.grading = {.fine_spacing = fine, .fine_radius = 1, .coarse_spacing = fine}});
  double wave = 0; // energy up to a factor, as all rings have the same width
  for (const auto& [r, v] : reference) wave += r * v * v;
  for (const double growth : {1.1, 1.15, 1.2, 1.5}) {
    double reflected = 0;
    for (const auto& [r, v] : after_crossing(graded(growth))) {
      const auto above = reference.lower_bound(r);
      if (r > fine_radius || above == reference.begin()) continue;
      const auto below = std::prev(above);
      const double part = (r - below->first) / (above->first - below->first);
      reflected += r * std::pow(v - below->second - part * (above->second - below->second), 2);
    }
    const double share = reflected / wave;
    std::printf("growth %.2f: %.4f of the wave's energy comes back\n", growth, share);
    if (growth <= 1.2) {
      EXPECT_LT(share, 0.01);
    }
  }
}

} // namespace
} // namespace spall::test
