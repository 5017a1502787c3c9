#include "macro/output/answers.h"

#include "tests/unit/output/small_bar.h"

#include <gtest/gtest.h>

namespace spall::test {
namespace {

TEST(MeasureBar, AnUndeformedBarHasItsOwnLengthAndDiameter) {
  for (const Boundary boundary : {Boundary::centred, Boundary::on_surface}) {
    SceneInputs s = small_bar(boundary);
    if (boundary == Boundary::on_surface) s.filling.layers = 9;
    const Simulation run = simulate(s);
    const BarShape bar = measure_bar(*run.bodies.solids[0], s);
    EXPECT_NEAR(bar.length, s.height, 1e-12);
    EXPECT_NEAR(bar.foot_diameter, s.diameter, 1e-12);
    EXPECT_EQ(bar.max_plastic_strain, 0);
    EXPECT_EQ(bar.plastic_strain_95, 0);
    EXPECT_EQ(bar.mean_plastic_strain, 0);
  }
}

TEST(MeasureBar, FollowsAHomogeneousDeformation) {
  const SceneInputs s = small_bar();
  const Simulation run = simulate(s);
  Points& points = run.bodies.solids[0]->points;
  // Radius times 1.2, height times 0.7, turned about the axis.
  const double a = 0.5, c = 1.2 * std::cos(a), d = 1.2 * std::sin(a);
  for (std::size_t i = 0; i < points.owned; ++i) {
    const Vec3 x = points.position[i];
    points.position.set(i, {c * x[0] - d * x[1], d * x[0] + c * x[1], 0.7 * x[2]});
    points.reference[i] = {c, -d, 0, d, c, 0, 0, 0, 0.7};
  }
  const BarShape bar = measure_bar(*run.bodies.solids[0], s);
  EXPECT_NEAR(bar.length, 0.7 * s.height, 1e-12);
  EXPECT_NEAR(bar.foot_diameter, 1.2 * s.diameter, 1e-12);
}

TEST(MeasureBar, TheQuantileIsBetweenMeanAndMaximumAfterAnImpact) {
  const SceneInputs s = small_bar();
  Simulation run = simulate(s);
  for (int i = 0; i < 150; ++i) run.advance();
  const BarShape bar = measure_bar(*run.bodies.solids[0], s);
  EXPECT_GT(bar.mean_plastic_strain, 0.01);
  EXPECT_GT(bar.plastic_strain_95, bar.mean_plastic_strain);
  EXPECT_GE(bar.max_plastic_strain, bar.plastic_strain_95);
  const auto strain = run.bodies.solids[0]->field("plastic_strain");
  double above = 0, volume = 0;
  for (std::size_t i = 0; i < strain.size(); ++i) {
    volume += run.bodies.solids[0]->points.volume[i];
    if (strain[i] > bar.plastic_strain_95) above += run.bodies.solids[0]->points.volume[i];
  }
  EXPECT_LE(above, 0.05 * volume);
  EXPECT_GT(above, 0.03 * volume);
}

} // namespace
} // namespace spall::test
