// Blocks of points that take longer steps than others: the answers, the energy and the momentum stay.

#include "tests/support/small_bar.h"

#include <gtest/gtest.h>

namespace spall::test {
namespace {

/// Numerics of a bar with a step factor as in the scenes.
TimeInputs subcycled(int subcycles) { return {.end_time = 1, .step_factor = 0.6, .subcycles = subcycles}; }

struct Flight {
  double momentum = 0, kinetic = 0, energy_error = 0, updates = 0;
  std::size_t steps = 0;
};

/// A bar whose two halves have cells of different stiffness after its foot has been crushed on the wall.
Flight shoot(int subcycles, double end) {
  Bar bar = small_bar();
  bar.height = 24e-3;
  bar.filling.layers = 24;
  SolidInputs numerics;
  numerics.integration.refresh_interval = 8;
  Simulation run = bar.shoot(numerics, subcycled(subcycles));
  while (run.time < end) run.advance();
  return {run.energies.points_momentum, run.energies.kinetic, run.energies.error(), run.updates, run.steps};
}

TEST(Subcycling, KeepsTheAnswerAndTheEnergyWithFewerUpdates) {
  const Flight every = shoot(1, 20e-6), some = shoot(4, 20e-6);
  EXPECT_NEAR(some.kinetic / every.kinetic, 1, 0.02);
  EXPECT_NEAR(some.momentum / every.momentum, 1, 0.02);
  EXPECT_LT(std::abs(some.energy_error), 1e-3);
  EXPECT_LT(some.updates / static_cast<double>(some.steps),
            0.8 * every.updates / static_cast<double>(every.steps));
}

/// A body in free flight that has been deformed unevenly vibrates: no force from outside, so the momenta
/// stay.
TEST(Subcycling, KeepsMomentumExactly) {
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
    EXPECT_LT(error.linear, 1e-12) << subcycles;
    EXPECT_NE(run.energies.points_momentum, 0);
    EXPECT_NEAR(run.energies.points_momentum, before, 1e-12 * std::abs(before)) << subcycles;
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
