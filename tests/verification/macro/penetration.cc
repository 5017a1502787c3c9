// A small concrete slab and the rigid projectile: balances that hold whatever the material does.

#include "macro/run_inputs.h"
#include "macro/scene/scene_inputs.h"
#include "shared/input/parameters.h"
#include "tests/verification/macro/bodies.h"

#include <gtest/gtest.h>

#include <utility>

namespace spall::test {
namespace {

TEST(Penetration, TheSlabGainsTheMomentumThatTheProjectileLosesAndEnergyIsKept) {
  SceneInputs scene;
  RunInputs numerics;
  Parameters parameters;
  scene.declare(parameters);
  numerics.declare(parameters);
  parameters.read(SPALL_DATA "/scenes/slab_127.prm",
                  {"Body/Diameter=0.4 m", "Body/Rings=14", "Body/Layers=8", "Time/End time=1 ms"});
  Points points = make_points(scene);
  scene.afc.load(points.spacing);
  Simulation run(make_solid(scene.afc, std::move(points), scene.planes(), numerics.solid),
                 make_rigid_body(scene), scene.contact, numerics.time, numerics.solid.integration);
  const double before = run.body.velocity[2];
  double work = 0, last = run.body.velocity[2], force_impulse = 0;
  while (run.time < 0.8e-3) {
    run.advance();
    force_impulse += run.contact_impulse[2];
    // The projectile's kinetic energy changes by its impulse times its mean velocity.
    work += run.contact_impulse[2] * 0.5 * (last + run.body.velocity[2]);
    last = run.body.velocity[2];
  }
  const Budget& b = run.budget;
  const double lost = run.body.mass * (before - run.body.velocity[2]);
  std::printf(
      "%zu points, %zu steps: %.1f m/s after %.1f, momentum error %.1e of what was lost, energy error %.1e\n",
      run.solids[0]->points.owned, run.steps, run.body.velocity[2], before,
      (b.momentum - b.initial_momentum) / lost, b.error());
  EXPECT_LT(run.body.velocity[2], 0.98 * before);
  EXPECT_GT(run.body.velocity[2], 0);
  EXPECT_NEAR(b.points_momentum, lost, 1e-3 * lost);
  EXPECT_NEAR(-force_impulse, lost, 1e-9 * lost);
  EXPECT_NEAR(b.body_kinetic - b.initial_energy, work, 1e-9 * b.initial_energy);
  EXPECT_LT(std::abs(b.error()), 1e-2);
  EXPECT_GE(b.friction, 0);
}

} // namespace
} // namespace spall::test
