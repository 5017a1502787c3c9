// Tests of bars that hit a rigid wall: one-dimensional theory, the converged Taylor bar, symmetry and
// threads.

#include "tests/verification/macro/aluminium_bar.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace spall::test {
namespace {

TEST(TaylorBar, ACoarseBarHasTheConvergedLengthAndKeepsItsEnergy) {
  const Bar scene = aluminium_bar(5, 31, {"x", "y"});
  Simulation run = shoot(scene);
  const BarShape bar = shape_at_rebound(run, scene);
  // Axisymmetric finite elements, converged, with the paper's constants and no friction: 0.7040, 16.66 mm,
  // mean plastic strain 0.4456, 95 % quantile 1.637. Diameter and quantile converge from below.
  EXPECT_NEAR(bar.length / scene.height, 0.704, 0.006);
  EXPECT_NEAR(bar.foot_diameter, 16.2e-3, 0.8e-3);
  EXPECT_NEAR(bar.mean_plastic_strain, 0.4456, 0.03);
  EXPECT_LT(std::abs(run.energies.error()), 5e-3);
  EXPECT_EQ(run.health.most_isolated, 0u);
}

TEST(TaylorBar, AQuarterIsTheFullBar) {
  const Bar quarter = aluminium_bar(4, 25, {"x", "y"}), full = aluminium_bar(4, 25, {});
  Simulation a = shoot(quarter), b = shoot(full);
  until_rebound(a);
  until_rebound(b);
  const BarShape p = shape_of(a), q = shape_of(b);
  std::printf("length %.4f and %.4f mm, foot %.4f and %.4f mm\n", p.length * 1e3, q.length * 1e3,
              p.foot_diameter * 1e3, q.foot_diameter * 1e3);
  EXPECT_NEAR(p.length, q.length, 0.03e-3);
  EXPECT_NEAR(p.foot_diameter, q.foot_diameter, 0.03e-3);
  EXPECT_EQ(4 * a.bodies.solids[0]->points.owned, b.bodies.solids[0]->points.owned);
}

TEST(TaylorBar, TheLengthAtReboundIsShorterThanThatOfTheFlyingBarByItsElasticCompression) {
  // The length at the moment when the momentum changes its sign includes the elastic compression. The
  // recovered bar has the mean length over a period of its longitudinal vibration, 2 L / c.
  const Bar scene = aluminium_bar(5, 31, {"x", "y"});
  Simulation run = shoot(scene);
  until_rebound(run);
  const double at_rebound = shape_of(run).length / scene.height;
  while (run.energies.impulse + run.energies.initial_momentum < 0 || run.impulse_given_by("bar")[2] != 0)
    run.advance();
  const double left = run.time, period = 2 * at_rebound * scene.height / std::sqrt(78.6e9 / 2700);
  double sum = 0, duration = 0, low = 1, high = 0;
  while (run.time < left + 2 * period) {
    run.advance();
    const double length = shape_of(run).length / scene.height;
    sum += run.step * length, duration += run.step;
    low = std::min(low, length), high = std::max(high, length);
  }
  std::printf("L/L0 %.4f at rebound, %.4f in flight, where it vibrates between %.4f and %.4f\n", at_rebound,
              sum / duration, low, high);
  // The difference is of the order of yield stress over Young's modulus, 0.0053.
  EXPECT_GT(sum / duration - at_rebound, 0.5 * 420e6 / 78.6e9);
  EXPECT_LT(sum / duration - at_rebound, 2 * 420e6 / 78.6e9);
}

TEST(TaylorBar, ThreadsDoNotChangeABit) {
  Bar scene = aluminium_bar(6, 37, {"x", "y"});
  scene.friction = 0.1;
  const auto run_with = [&](int threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    Simulation run = shoot(scene);
    for (int n = 0; n < 100; ++n) run.advance();
    return run;
  };
  const Simulation one = run_with(1), two = run_with(2);
  for (int c = 0; c < 3; ++c) {
    EXPECT_EQ(one.bodies.solids[0]->points.position.component[c],
              two.bodies.solids[0]->points.position.component[c]);
    EXPECT_EQ(one.bodies.solids[0]->points.velocity.component[c],
              two.bodies.solids[0]->points.velocity.component[c]);
  }
  EXPECT_EQ(one.bodies.solids[0]->field("plastic_strain"), two.bodies.solids[0]->field("plastic_strain"));
  EXPECT_EQ(one.energies.total(), two.energies.total());
  EXPECT_GT(one.energies.impulse, 0);
}

TEST(Wall, TheImpulseIsTheChangeOfMomentum) {
  for (const double friction : {0.0, 0.2}) {
    Bar scene = aluminium_bar(3, 19, {});
    scene.friction = friction;
    Simulation run = shoot(scene, {.double_precision = true});
    const double before = run.energies.points_momentum;
    for (int n = 0; n < 300; ++n) run.advance();
    EXPECT_GT(run.energies.impulse, -0.5 * before);
    EXPECT_NEAR(run.energies.points_momentum - before, run.energies.impulse, 1e-12 * -before);
    EXPECT_LT(std::abs(run.energies.error()), 5e-3);
    if (friction > 0) {
      EXPECT_GT(run.energies.friction, 0);
    }
  }
}

TEST(Wall, AnElasticBarLeavesAfterTheWaveHasRunForthAndBackWithItsVelocity) {
  // In one-dimensional theory (Poisson's ratio 0) contact lasts 2 L / c, the stress is rho c v, and the bar
  // rebounds at its initial speed.
  const J2 material = elastic(78.6e9, 0);
  const double length = 0.1, speed = 1, c = std::sqrt(material.youngs_modulus / material.density);
  const int layers = 80;
  const double h = length / layers;
  Points points = fill_cylinder({.radius = 2 * h, .height = length, .bottom = 0},
                                {2, layers, Boundary::on_surface}, SymmetryPlanes{}, material.density);
  set_velocity(points, [&](const Vec3&) { return Vec3{0, 0, -speed}; });
  double mass = 0;
  for (const double m : points.mass) mass += m;
  const Numerics numerics;
  const SolidInputs inputs = numerics.solid();
  Bodies bodies;
  bodies.solids.push_back(make_solid(material, points, SymmetryPlanes{}, inputs));
  bodies.solids[0]->label = "bar";
  bodies.rigids.push_back(wall_at_zero());
  Simulation run(std::move(bodies), {}, {.end_time = 1}, inputs.integration);
  double last_touch = 0, half_impulse = 0;
  while (run.time < 3 * length / c) {
    run.advance();
    if (run.impulse_given_by("bar")[2] != 0) last_touch = run.time;
    if (run.time < length / c) half_impulse = run.energies.impulse;
  }
  const double restitution = run.energies.points_momentum / (mass * speed);
  std::printf("contact time %.3f of 2 L / c, restitution %.4f, lost in the contact %.4f of the energy\n",
              last_touch / (2 * length / c), restitution, run.energies.contact / run.energies.initial);
  EXPECT_NEAR(last_touch, 2 * length / c, 0.05 * 2 * length / c);
  EXPECT_NEAR(half_impulse, mass * speed,
              0.02 * mass * speed); // the bar is at rest when the wave has reached its end
  EXPECT_NEAR(restitution, 1, 0.03);
}

} // namespace
} // namespace spall::test
