#include "macro/dynamics/simulation.h"

#include "macro/dynamics/body_motion.h"
#include "shared/error.h"
#include "tests/unit/dynamics/bodies_of.h"
#include "tests/verification/macro/bodies.h"

#include <gtest/gtest.h>

namespace spall::test {
namespace {

TEST(Simulation, VelocitiesAdvanceFromTheMiddleOfOneStepToTheMiddleOfTheNext) {
  const J2 material = elastic();
  Simulation run = free_flight(material, block(material, 4, 1e-3, 0), {.refresh_interval = 1});
  Points& points = run.bodies.solids[0]->points;
  run.advance();
  const double first = run.step;
  // The cells shrink, so the next step is shorter. A force is set that the next step integrates to a
  // velocity.
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

TEST(Simulation, TheFirstVelocityStepIsHalfAStep) {
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

/// Makes a vibrating block with a step of 1.6 h / c.
Simulation block_with_long_steps(int verify_every) {
  const J2 material = elastic();
  Points points = block(material, 6, 1e-3, 0.1);
  set_velocity(points, [](const Vec3& x) {
    return Vec3{10 * std::sin(900 * x[1]), 10 * std::cos(700 * x[0]), 0};
  });
  return free_flight(material, points, {.step_factor = 1.6, .verify_every = verify_every});
}

TEST(Health, WarnsOfStepsThatAreShorterThanHalfOfWhatWasAskedFor) {
  Health health;
  health.note_short_step(0.55, 0.6, 1e-6);
  EXPECT_TRUE(health.warnings.empty());
  health.note_short_step(0.29, 0.6, 2e-6);
  ASSERT_EQ(health.warnings.size(), 1u);
  EXPECT_NE(health.warnings[0].find("from 0.6 (Time/Step factor) to 0.29 h / c"), std::string::npos);
  EXPECT_EQ(health.step_reductions, 2u);
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

/// Makes a block of 5 mm on a fixed wall, and a free disc that hits it from above at 5 m/s.
Simulation block_between_rigid_bodies(double step_factor = 0.5) {
  const J2 material = elastic();
  Bodies bodies = bodies_of(make_solid(material, block(material, 5, 1e-3, 0), {}, Numerics{}.solid()),
                            {.name = "wall",
                             .shape = PlaneWall{},
                             .position = {0, 0, 0.49e-3}, // just below the lowest points
                             .free = {false, false, false}});
  bodies.rigids.push_back({.name = "disc",
                           .shape = Cylinder{.radius = 1, .height = 1e-3},
                           .mass = 1e-3,
                           .position = {0, 0, 4.51e-3},
                           .velocity = {0, 0, -5}});
  return {std::move(bodies), {}, {.end_time = 1, .step_factor = step_factor}, Numerics{}.solid().integration};
}

TEST(Simulation, SeveralRigidBodiesExchangeImpulsesWithASolid) {
  Simulation run = block_between_rigid_bodies();
  const std::size_t block = run.bodies.index("body"), wall = run.bodies.index("wall"),
                    disc = run.bodies.index("disc");
  EXPECT_EQ(wall, 1u);
  EXPECT_EQ(disc, 2u);
  const double before = run.energies.momentum;
  EXPECT_NEAR(before, -5e-3, 1e-15);
  Vec3 sum{};
  for (int n = 0; n < 400; ++n) {
    run.advance();
    sum += run.exchange.of_step.given(disc, block);
  }
  const ImpulseMatrix& all = run.exchange.of_run;
  EXPECT_LT(all.given(disc, block)[2], -1e-3);
  EXPECT_GT(all.given(wall, block)[2], 1e-3);
  EXPECT_EQ(all.given(wall, disc), Vec3{}); // rigid bodies pass through each other
  EXPECT_EQ(all.given(block, disc)[2], -all.given(disc, block)[2]);
  EXPECT_NEAR(sum[2], all.given(disc, block)[2], 1e-15);
  const RigidBody& body = *run.bodies.rigid("disc");
  EXPECT_NEAR(body.mass * (body.velocity[2] + 5), all.given(block, disc)[2], 1e-15);
  EXPECT_NEAR(run.energies.points_momentum, all.received(block)[2], 1e-15);
  EXPECT_NEAR(run.energies.momentum - before, all.given(wall, block)[2], 1e-15);
  EXPECT_NEAR(run.energies.impulse, all.received(block)[2], 1e-15);
  EXPECT_GT(body.velocity[2], 0); // it has rebounded
}

TEST(Simulation, TheEnergyOfASolidBetweenRigidBodiesIsKeptTheBetterTheShorterTheStep) {
  const auto largest_error = [](double step_factor) {
    Simulation run = block_between_rigid_bodies(step_factor);
    while (run.time < 30e-6) run.advance();
    return run.health.largest_energy_error;
  };
  const double coarse = largest_error(0.4), fine = largest_error(0.1);
  EXPECT_LT(coarse, 0.05);
  EXPECT_LT(fine, coarse / 8); // second order
}

TEST(Simulation, AnEnergyThatIsNoNumberStopsTheRunWithTimeAndReason) {
  Simulation run = block_between_rigid_bodies();
  run.advance();
  run.bodies.rigids[1].velocity[0] = std::nan("");
  run.bodies.rigids[1].position[2] = 1; // touches nothing
  try {
    run.advance();
    FAIL();
  } catch (const ComputationError& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find("t = "), 0u) << message;
    EXPECT_NE(message.find("the energy is not finite"), std::string::npos) << message;
    EXPECT_NE(message.find("kinetic nan"), std::string::npos) << message;
  }
}

TEST(Health, WarnsOfAnErrorThatIsNoNumber) {
  Health health;
  health.note_energy_error(1e-4, 0);
  EXPECT_TRUE(health.warnings.empty());
  health.note_energy_error(std::nan(""), 1);
  EXPECT_EQ(health.warnings.size(), 1u);
  health.note_energy_error(1e-3, 2);
  EXPECT_TRUE(std::isnan(health.largest_energy_error)); // the error stays recorded
}

TEST(Health, WarnsOnceTheMaterialsHaveCreatedEnergy) {
  Health health;
  for (const double dissipated : {0., 50., 49.5, 60.}) health.note_dissipated(dissipated, 100, 0);
  EXPECT_DOUBLE_EQ(health.energy_created, 0.005);
  EXPECT_TRUE(health.warnings.empty());
  health.note_dissipated(57, 100, 1);
  EXPECT_DOUBLE_EQ(health.energy_created, 0.03);
  ASSERT_EQ(health.warnings.size(), 1u);
  EXPECT_NE(health.warnings[0].find("created 3 % of the initial energy"), std::string::npos);
  health.note_dissipated(80, 100, 2);
  EXPECT_DOUBLE_EQ(health.energy_created, 0.03);
}

TEST(Bodies, HaveNamesOfTheirOwn) {
  const J2 material = elastic();
  const auto bodies = [&](const std::string& name) {
    return bodies_of(make_solid(material, block(material, 3, 1e-3, 0), {}, Numerics{}.solid()),
                     {.name = name, .shape = PlaneWall{}});
  };
  EXPECT_NO_THROW(bodies("wall").validate());
  EXPECT_THROW(bodies("body").validate(), InputError);
  const Bodies found = bodies("wall");
  EXPECT_EQ(found.solid("body"), found.solids[0].get());
  EXPECT_EQ(found.rigid("wall"), &found.rigids[0]);
  EXPECT_EQ(found.solid("wall"), nullptr);
  EXPECT_EQ(found.rigid("body"), nullptr);
  EXPECT_THROW(found.index("roof"), std::out_of_range);
}

TEST(BodyMotion, OfATurningBlockIsThatOfTheRigidMotion) {
  const J2 material = elastic();
  const Vec3 centre = {2e-3, 2e-3, 2e-3}, velocity = {3, 0, -4};
  Points points = block(material, 4, 1e-3, 0);
  set_velocity(points, [&](const Vec3& x) { return velocity + cross(Vec3{0, 50, 0}, x - centre); });
  const auto solid = make_solid(material, std::move(points), {}, Numerics{}.solid());
  const BodyMotion motion = motion_of(*solid);
  EXPECT_NEAR(motion.front, 4e-3, 1e-12);
  EXPECT_NEAR(motion.rear, 0, 1e-12);
  EXPECT_NEAR(motion.turning[1], 50, 1e-9);
  EXPECT_NEAR(motion.speed(), -5, 1e-12);
  EXPECT_NEAR(motion.axis[2], 1, 1e-12);
}

} // namespace
} // namespace spall::test
