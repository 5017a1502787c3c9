// Blocks of points that take longer steps than others: the answers, the energy and the momentum stay.

#include "tests/support/scenes.h"
#include "tests/support/small_bar.h"

#include <gtest/gtest.h>

#include <cstdio>

namespace spall::test {
namespace {

/// A step factor as in the scenes.
TimeInputs subcycled(int subcycles) { return {.end_time = 1, .step_factor = 0.6, .subcycles = subcycles}; }

/// A slab around the axis with a projectile in it, whose cells are pressed flat beside the nose.
struct Shot {
  double velocity = 0, energy_error = 0, updates_per_step = 0;
};
Shot shoot(int subcycles) {
  // A refresh waits for the end of the cycle: with an interval of 4 both have neighbours of the same age.
  const auto scene =
      shipped("slab_127_u.prm", {"slab/Rings=48", "slab/Layers=12", "Integration/Refresh interval=4",
                                 "Time/Subcycles=" + std::to_string(subcycles)});
  Simulation run = start(*scene);
  while (run.time < 0.3e-3) run.advance();
  return {run.bodies.rigids[0].velocity[2], run.energies.error(),
          run.updates / static_cast<double>(run.steps) / static_cast<double>(run.point_count())};
}

TEST(Subcycling, KeepsTheAnswerAndTheEnergyWithFewerUpdates) {
  const Shot every = shoot(1), some = shoot(4);
  std::printf("%.2f m/s, with four subcycles %.2f m/s\n", every.velocity, some.velocity);
  EXPECT_NEAR(some.velocity, every.velocity, 0.01 * (313 - every.velocity));
  EXPECT_LT(std::abs(some.energy_error), 1e-3);
  EXPECT_EQ(every.updates_per_step, 1);
  EXPECT_LT(some.updates_per_step, 0.9);
}

/// A body in free flight that has been deformed unevenly vibrates: no force from outside, so the momenta
/// stay.
TEST(Subcycling, KeepsMomentumToRoundOff) {
  for (const int subcycles : {1, 2, 4, 8}) {
    Bar bar = small_bar();
    bar.velocity = 0;
    Bodies bodies;
    bodies.solids.push_back(bar.solid());
    Points& points = bodies.solids[0]->points;
    double before = 0;
    for (std::size_t i = 0; i < points.owned; ++i) {
      const Vec3 x = points.position[i];
      points.velocity.set(i, {20 * x[2] / bar.height, 5, x[2] < 2e-3 ? 100. : -20.});
      before += points.mass[i] * points.velocity[i][2];
    }
    Simulation run(std::move(bodies), {}, subcycled(subcycles), {});
    for (int n = 0; n < 50; ++n) run.advance();
    const MomentumError error = run.momentum_error();
    // Gradients are in single precision.
    EXPECT_LT(error.linear, 2e-7) << subcycles;
    EXPECT_NEAR(run.energies.points_momentum, before, 1e-6 * std::abs(before)) << subcycles;
  }
}

TEST(Subcycling, EqualCellsStepTogether) {
  Bar bar = small_bar();
  bar.velocity = 0;
  Bodies bodies;
  bodies.solids.push_back(bar.solid());
  Simulation run(std::move(bodies), {}, subcycled(4), {});
  for (int n = 0; n < 5; ++n) run.advance();
  EXPECT_EQ(run.steps, 20u);
  EXPECT_EQ(run.updates, 20. * static_cast<double>(run.point_count()));
}

TEST(Subcycling, RatiosArePowersOfTwoWithinTheCycle) {
  const Subcycle subcycle{.step = 3, .steps = 4, .stable_step = 1};
  EXPECT_EQ(subcycle.ratio(1), 1);
  EXPECT_EQ(subcycle.ratio(1.99), 1);
  EXPECT_EQ(subcycle.ratio(2), 2);
  EXPECT_EQ(subcycle.ratio(3.99), 2);
  EXPECT_EQ(subcycle.ratio(100), 4);
  EXPECT_TRUE(subcycle.ends(1) && subcycle.ends(2) && subcycle.ends(4));
  EXPECT_FALSE(subcycle.begins(2));
}

} // namespace
} // namespace spall::test
