#include "macro/dynamics/simulation.h"

#include "shared/error.h"
#include "tests/verification/macro/bodies.h"

#include <gtest/gtest.h>

namespace spall::test {
namespace {

TEST(Simulation, AKickSpansFromTheMiddleOfOneStepToTheMiddleOfTheNext) {
  const J2 material = elastic();
  Simulation run = free_flight(material, block(material, 4, 1e-3, 0), {.refresh_interval = 1});
  Points& points = run.bodies.solids[0]->points;
  run.advance();
  const double first = run.step;
  // The cells shrink: the next step is shorter. A force that the next step must turn into velocity.
  const Mat3 smaller = {0.7, 0, 0, 0, 0.7, 0, 0, 0, 0.7};
  points.reference.assign(points.owned, smaller);
  for (std::size_t i = 0; i < points.owned; ++i) points.force.set(i, {0, 2.5, 0});
  const Vec3 before = points.velocity[5], x = points.position[5];
  run.advance();
  EXPECT_NEAR(run.step, 0.7 * first, 1e-9 * first);
  const double kick = 0.5 * (first + run.step) * 2.5 / points.mass[5];
  EXPECT_NEAR(points.velocity[5][1] - before[1], kick, 1e-12 * kick);
  EXPECT_NEAR(points.position[5][1] - x[1], run.step * points.velocity[5][1], 1e-15);
  EXPECT_NEAR(run.time, first + run.step, 1e-20);
}

TEST(Simulation, TheFirstKickIsHalfAStep) {
  const J2 material = elastic();
  Simulation run = free_flight(material, block(material, 4, 1e-3, 0), {});
  Points& points = run.bodies.solids[0]->points;
  for (std::size_t i = 0; i < points.owned; ++i) points.force.set(i, {0, 2.5, 0});
  run.advance();
  const double kick = 0.5 * run.step * 2.5 / points.mass[5];
  EXPECT_NEAR(points.velocity[5][1], kick, 1e-12 * kick);
}

TEST(Simulation, TheStepIsTheFactorTimesTheSmallestCellOverTheWaveSpeed) {
  const J2 material = elastic();
  Points points = block(material, 4, 1e-3, 0);
  points.reference[17][0] = 0.8; // one cell is shorter along x
  Simulation run = free_flight(material, points, {.step_factor = 0.3});
  run.advance();
  EXPECT_NEAR(run.step, 0.3 * 0.8 * 1e-3 / material.sound_speed({}), 1e-9 * run.step);
}

/// A block that vibrates with a step of 1.6 h / c.
Simulation block_with_long_steps(int verify_every) {
  const J2 material = elastic();
  Points points = block(material, 6, 1e-3, 0.1);
  set_velocity(points, [](const Vec3& x) {
    return Vec3{10 * std::sin(900 * x[1]), 10 * std::cos(700 * x[0]), 0};
  });
  return free_flight(material, points, {.step_factor = 1.6, .verify_every = verify_every});
}

TEST(Simulation, ShortensAStepThatTheStiffnessDoesNotAllow) {
  Simulation run = block_with_long_steps(50);
  for (int n = 0; n < 300; ++n) run.advance();
  EXPECT_LT(std::abs(run.energies.error()), 0.05);
  EXPECT_EQ(run.health.step_reductions, 6u);
  EXPECT_LT(run.health.smallest_step_margin, 1);
  EXPECT_GT(run.health.smallest_step_margin, 0.4);

  Simulation blind = block_with_long_steps(0);
  EXPECT_THROW(
      {
        for (int n = 0; n < 300; ++n) blind.advance();
      },
      ComputationError);
}

} // namespace
} // namespace spall::test
