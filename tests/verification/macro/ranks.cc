// Tests that a body that is distributed over the processes of mpirun moves as in one process.

#include "macro/dynamics/body_motion.h"
#include "macro/restart/checkpoint.h"
#include "macro/restart/rebalance.h"
#include "shared/error.h"
#include "shared/traffic.h"
#include "tests/support/small_bar.h"
#include "tests/unit/solid/crowded_points.h"
#include "tests/verification/macro/bodies.h"
#include "tests/verification/macro/over_ranks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <optional>

namespace spall::test {

Ranks ranks;

namespace {

class Spread : public ::testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Bodies, Spread, ::testing::ValuesIn(scheme_cases()),
                         [](const auto& instance) { return instance.param.name; });

/// Returns the largest difference between this rank's part and the same part of the whole, relative to the
/// largest value.
double difference(const VectorField& part, const VectorField& whole, std::size_t first, std::size_t count) {
  double largest = 0, change = 0;
  for (int c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < count; ++i) {
      const double a = part.component[c][i], b = whole.component[c][first + i];
      largest = std::max(largest, std::abs(b)), change = std::max(change, std::abs(a - b));
    }
  return change / ranks.max(largest);
}

/// Compares this rank's points of a body with those of the whole.
void expect_same_points(const Solid& mine, const Solid& all, double tolerance) {
  const std::size_t n = mine.points.owned, first = mine.ghosts.remote_points().first();
  EXPECT_EQ(ranks.sum(static_cast<double>(n)), static_cast<double>(all.points.owned));
  EXPECT_LT(difference(mine.points.position, all.points.position, first, n), tolerance) << mine.label;
  EXPECT_LT(difference(mine.points.velocity, all.points.velocity, first, n), tolerance) << mine.label;
  EXPECT_LT(difference(mine.points.force, all.points.force, first, n), 100 * tolerance) << mine.label;
}

void expect_same_run(const Simulation& whole, const Simulation& spread, const Case& c) {
  for (std::size_t b = 0; b < whole.bodies.solids.size(); ++b)
    expect_same_points(*spread.bodies.solids[b], *whole.bodies.solids[b], c.tolerance);
  const auto near = [&](double a, double b, double scale) { EXPECT_NEAR(a, b, c.tolerance * scale); };
  const Energies &a = spread.energies, &b = whole.energies;
  near(spread.time, whole.time, whole.time);
  for (const auto member : {&Energies::kinetic, &Energies::rigid_kinetic, &Energies::stabilization,
                            &Energies::friction, &Energies::contact, &Energies::damping, &Energies::rings})
    near(a.*member, b.*member, b.initial);
  near(a.internal.total, b.internal.total, b.initial);
  near(a.internal.compression, b.internal.compression, b.initial);
  near(a.impulse, b.impulse, std::abs(b.impulse));
  double met = 0;
  for (std::size_t k = 0; k < whole.bodies.solids.size(); ++k) {
    near(a.solid_momentum[k], b.solid_momentum[k], std::abs(b.initial_momentum));
    near(a.solid_work[k], b.solid_work[k], b.initial);
  }
  for (std::size_t from = 0; from < whole.bodies.count(); ++from)
    for (std::size_t to = 0; to < whole.bodies.count(); ++to) {
      const double given = whole.exchange.of_run.given(from, to)[2];
      near(spread.exchange.of_run.given(from, to)[2], given, std::abs(b.initial_momentum));
      met = std::max(met, std::abs(given));
    }
  EXPECT_GT(met, 0);
  for (const RigidBody& body : whole.bodies.rigids) {
    const RigidBody& other = *spread.bodies.rigid(body.name);
    near(other.velocity[2], body.velocity[2], 1 + std::abs(body.velocity[2]));
    near(other.position[2], body.position[2], 1);
  }
  for (const auto& solid : whole.bodies.solids) {
    const BodyMotion one = motion_of(whole.bodies, solid->label),
                     many = motion_of(spread.bodies, solid->label);
    near(many.front, one.front, 1), near(many.rear, one.rear, 1), near(many.speed(), one.speed(), 100);
  }
  near(spread.momentum_error().linear, whole.momentum_error().linear, 1);
  const Health &mine = spread.health, &all = whole.health;
  near(spread.exchange.mean_gap(), whole.exchange.mean_gap(), whole.exchange.mean_gap());
  near(mine.smallest_step_margin, all.smallest_step_margin, 1);
  for (std::size_t k = 0; k < all.hourglass.size(); ++k) {
    near(mine.hourglass[k].position_saw_tooth, all.hourglass[k].position_saw_tooth, 1);
    near(mine.hourglass[k].plastic_saw_tooth, all.hourglass[k].plastic_saw_tooth, 1);
    near(mine.hourglass[k].volume_mismatch, all.hourglass[k].volume_mismatch, 1);
  }
  EXPECT_EQ(mine.refreshes, all.refreshes);
  EXPECT_EQ(mine.refreshed_points, all.refreshed_points);
  EXPECT_EQ(mine.most_isolated, all.most_isolated);
}

/// Runs a case for 200 steps in one process and distributed. @param between is applied to the distributed run
/// after every step
void run_both(const Case& c, const std::function<void(Simulation&)>& between = {}) {
  Simulation whole = start(c), spread = start(c, ranks);
  for (int step = 0; step < 200; ++step) {
    whole.advance(), spread.advance();
    if (between) between(spread);
  }
  if (ranks.several() && !between) {
    const Solid& mine = *spread.bodies.solids[0];
    EXPECT_LT(mine.points.owned, whole.bodies.solids[0]->points.owned);
    EXPECT_GT(ranks.sum(static_cast<double>(mine.ghosts.remote_points().size())), 0);
  }
  expect_same_run(whole, spread, c);
}

TEST_P(Spread, MovesAsItDoesInOneProcess) { run_both(GetParam()); }

TEST_P(Spread, MovesAsItDoesInOneProcessWhenPointsGoToOtherRanks) {
  run_both(GetParam(), [](Simulation& run) {
    // The first ranks get few points or none, later the last ones.
    if (run.steps != 40 && run.steps != 110) return;
    const auto count = static_cast<std::uint64_t>(ranks.count());
    std::vector<std::vector<std::uint64_t>> cuts(run.bodies.solids.size());
    for (std::size_t s = 0; s < run.bodies.solids.size(); ++s) {
      const std::uint64_t all = ranks.share(run.bodies.solids[s]->points.owned).all,
                          block_size = run.bodies.solids[s]->block_size,
                          blocks = (all + block_size - 1) / block_size;
      for (std::uint64_t r = 0; r <= count; ++r) {
        const std::uint64_t k = run.steps == 40 ? r : count - r, part = blocks * k * k / (count * count);
        cuts[s].push_back(run.steps == 40 ? part : blocks - part);
      }
    }
    move_points(run, cuts);
  });
}

/// Makes a whole run, in which points are redistributed when the load is unbalanced. @param done is called
/// after every step; the run ends if it returns true. @param faster multiplies the velocities of rigid bodies
Simulation run_to_its_end(const Case& c, const Ranks& of, const std::function<bool(const Simulation&)>& done,
                          double faster = 1) {
  Simulation run = start(c, of);
  for (RigidBody& body : run.bodies.rigids) body.velocity[2] *= faster;
  const auto inputs = c.file();
  Balancer balancer(inputs->run.balance);
  bool ended = false;
  while (!ended && run.time < inputs->run.time.end_time) run.advance(), balancer.look(run), ended = done(run);
  EXPECT_TRUE(ended);
  return run;
}

/// A perforation magnifies round-off: runs of this coarse slab whose impact velocities differ by 1e-7 to 1e-6
/// deviate by 0.8 % in the exit velocity. So the distributed run is held against the scatter of runs in one
/// process whose impact velocities differ by as little as single precision can tell.
TEST(SpreadToTheEnd, TheProjectileLeavesTheSlabAsItDoesInOneProcess) {
  const Case c = slab("slab", false, 0);
  const auto out = [](const Simulation& run) { return run.bodies.rigid("projectile")->rear() > 0.127; };
  double mean = 0, squares = 0;
  const std::vector<double> changes = {0, -1e-6, -3e-7, -1e-7, 1e-7, 3e-7, 1e-6};
  const auto count = static_cast<double>(changes.size());
  for (const double change : changes) {
    const double v = run_to_its_end(c, {}, out, 1 + change).bodies.rigid("projectile")->velocity[2];
    mean += v / count, squares += v * v / count;
  }
  const double deviation = std::sqrt(std::max(0., squares - mean * mean) * count / (count - 1)),
               spread = run_to_its_end(c, ranks, out).bodies.rigid("projectile")->velocity[2];
  EXPECT_LT(deviation, 0.015 * mean);
  EXPECT_NEAR(spread, mean, 3 * deviation + 1e-3 * mean);
}

TEST(SpreadToTheEnd, TheBarIsAsShortAsItIsInOneProcess) {
  const Case c = bar("bar", {"Time/End time=1 ms", "Approximation/Double precision=no"});
  const auto rebounds = [](const Simulation& run) { return run.energies.solid_momentum[0] >= 0; };
  const auto length = [&](const Ranks& of) {
    const Simulation run = run_to_its_end(c, of, rebounds);
    const std::vector<double>& z = run.bodies.solids[0]->points.position.component[2];
    double low = 1e300, high = -1e300;
    for (std::size_t i = 0; i < run.bodies.solids[0]->points.owned; ++i)
      low = std::min(low, z[i]), high = std::max(high, z[i]);
    return of.max(high) - of.min(low);
  };
  const double alone = length({});
  EXPECT_NEAR(length(ranks), alone, 1e-3 * alone);
}

/// Compares a distributed run with one on the first rank alone.
void expect_same(const Simulation& spread, const Simulation& alone, double tolerance) {
  for (std::size_t b = 0; b < spread.bodies.solids.size(); ++b) {
    const Points &mine = spread.bodies.solids[b]->points, &all = alone.bodies.solids[b]->points;
    for (int c = 0; c < 3; ++c) {
      const std::vector<double>& x = mine.position.component[c];
      const std::vector<double> joined =
          ranks.join(std::vector<double>(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(mine.owned)));
      for (std::size_t i = 0; i < all.owned && ranks.first(); ++i)
        ASSERT_NEAR(joined[i], all.position.component[c][i], 0.1 * tolerance)
            << spread.bodies.solids[b]->label;
    }
  }
  if (!ranks.first()) return;
  EXPECT_EQ(spread.steps, alone.steps);
  EXPECT_NEAR(spread.energies.total(), alone.energies.total(), tolerance * alone.energies.initial);
  EXPECT_NEAR(spread.energies.momentum, alone.energies.momentum,
              tolerance * std::abs(alone.energies.initial_momentum));
}

TEST_P(Spread, ContinuesOnAnotherNumberOfProcesses) {
  const SharedFolder folder;
  const Case c = GetParam();
  const auto advance = [](Simulation& run) {
    for (int step = 0; step < 40; ++step) run.advance();
  };
  Simulation spread = start(c, ranks), alone = start(c);
  advance(spread);
  Checkpoints together(folder.path, {}, {}, ranks), own(folder.path, {});
  together.write([&](Archive& archive) { spread.transfer(archive); });
  if (ranks.first()) {
    ASSERT_TRUE(own.find());
    own.load([&](Archive& archive) { alone.transfer(archive); });
    advance(alone);
  }
  advance(spread);
  expect_same(spread, alone, c.tolerance);
  // The way back: from one process to several.
  Simulation resumed = start(c, ranks);
  ranks.on_first([&] { own.write([&](Archive& archive) { alone.transfer(archive); }); });
  ASSERT_TRUE(together.find());
  together.load([&](Archive& archive) { resumed.transfer(archive); });
  advance(resumed);
  if (ranks.first()) advance(alone);
  expect_same(resumed, alone, c.tolerance);
}

TEST(SpreadBody, ContinuesBitForBitFromACheckpoint_slab) {
  const SharedFolder folder;
  const auto advance = [](Simulation& run) {
    for (int step = 0; step < 40; ++step) run.advance();
  };
  Simulation whole = spread_slab(), resumed = spread_slab();
  advance(whole);
  Checkpoints checkpoints(folder.path, {}, {}, ranks);
  checkpoints.write([&](Archive& archive) { whole.transfer(archive); });
  advance(whole);
  ASSERT_TRUE(checkpoints.find());
  checkpoints.load([&](Archive& archive) { resumed.transfer(archive); });
  EXPECT_EQ(resumed.steps, 40u);
  advance(resumed);
  for (int c = 0; c < 3; ++c) {
    EXPECT_EQ(resumed.bodies.solids[0]->points.position.component[c],
              whole.bodies.solids[0]->points.position.component[c]);
    EXPECT_EQ(resumed.bodies.solids[0]->points.velocity.component[c],
              whole.bodies.solids[0]->points.velocity.component[c]);
  }
  EXPECT_EQ(resumed.energies.total(), whole.energies.total());
}

/// Traffic of all ranks for one purpose since `before` was recorded.
struct Sent {
  double messages = 0, bytes = 0, collectives = 0;
  explicit Sent(MpiUse use) {
    const Traffic t = traffic_of(use);
    messages = static_cast<double>(t.messages), bytes = static_cast<double>(t.bytes);
    collectives = static_cast<double>(t.collectives);
    ranks.reduce({.sums = {&messages, &bytes, &collectives}});
  }
};

TEST(SpreadBody, SendsNoMoreThanItsSurfaceInAStep_slab) {
  Simulation run = spread_slab();
  run.advance();
  // Between refreshes the remote points do not change, so the receivers know the number of bytes sent.
  double remote = static_cast<double>(run.bodies.solids[0]->ghosts.remote_points().size());
  ranks.reduce({.sums = {&remote}});
  const std::array<MpiUse, 3> uses = {MpiUse::velocities, MpiUse::forces, MpiUse::reductions};
  std::vector<Sent> before(uses.begin(), uses.end());
  const std::size_t refreshes = run.health.refreshes;
  constexpr int steps = 3;
  for (int step = 0; step < steps; ++step) run.advance();
  ASSERT_EQ(run.health.refreshes, refreshes);
  const std::vector<Sent> after(uses.begin(), uses.end());
  for (int k : {0, 1}) EXPECT_EQ(after[k].bytes - before[k].bytes, steps * remote * 3 * sizeof(double));
  EXPECT_EQ(after[0].messages - before[0].messages, after[1].messages - before[1].messages);
  EXPECT_LE(after[0].messages - before[0].messages, steps * ranks.count() * (ranks.count() - 1));
  EXPECT_EQ(after[2].messages, before[2].messages);
  const double several = ranks.several();
  EXPECT_EQ(after[2].collectives - before[2].collectives, several * steps * ranks.count());
  EXPECT_EQ(after[0].messages > before[0].messages, ranks.several());
  if (!ranks.several()) {
    EXPECT_EQ(seconds_in_mpi(), 0);
  }
}

/// Makes two bonded bars that move apart.
Simulation bonded_bars(const Ranks& of) {
  J2 material = aluminium();
  SolidInputs inputs;
  inputs.ranks = of, inputs.double_precision = true;
  Bodies bodies;
  for (const bool upper : {true, false}) {
    Points points = fill_cylinder({.radius = 4e-3, .height = 16e-3, .bottom = upper ? 0 : -16e-3},
                                  {4, 16, Boundary::centred}, {{true, false, false}}, material.density);
    for (std::size_t i = 0; i < points.owned; ++i) points.velocity.set(i, {0, 3, upper ? 5.0 : -5.0});
    bodies.solids.push_back(make_solid(material, std::move(points), {{true, false, false}}, inputs));
    bodies.solids.back()->label = upper ? "upper" : "lower";
  }
  return {std::move(bodies), {.bonded = {{"upper", "lower"}}}, {.end_time = 1}, inputs.integration};
}

TEST(SpreadBody, BondedBarsMoveAsTheyDoInOneProcess_bodies) {
  Simulation whole = bonded_bars({}), spread = bonded_bars(ranks);
  for (int step = 0; step < 100; ++step) whole.advance(), spread.advance();
  for (std::size_t b = 0; b < 2; ++b)
    expect_same_points(*spread.bodies.solids[b], *whole.bodies.solids[b], 1e-9);
  const Vec3 given = whole.exchange.of_run.given(0, 1);
  EXPECT_GT(given[2], 0);
  EXPECT_NEAR(spread.exchange.of_run.given(0, 1)[2], given[2], 1e-9 * given[2]);
  EXPECT_NEAR(spread.energies.total(), whole.energies.total(), 1e-9 * whole.energies.initial);
}

TEST(SpreadBody, WhatOneProcessThrowsIsThrownOnAll_slab) {
  const int last = ranks.count() - 1;
  std::string message;
  try {
    ranks.on_all([&] {
      if (ranks.rank() == last)
        throw ComputationError("the cloud of rank " + std::to_string(last) + " has collapsed");
    });
  } catch (const ComputationError& error) {
    message = error.what();
  }
  EXPECT_EQ(message, "the cloud of rank " + std::to_string(last) + " has collapsed");
  EXPECT_EQ(ranks.sum(1), ranks.count()); // all ranks can still communicate
  EXPECT_NO_THROW(ranks.on_all([] {}));
}

TEST(SpreadBody, FailsOnAllProcessesWithOneMessage) {
  Simulation run = start(
      bar("unstable", {"Time/Step factor=1", "Time/Verify step every=0", "bar/Velocity=-5000 m/s"}), ranks);
  std::string message;
  try {
    for (int step = 0; step < 2000; ++step) run.advance();
  } catch (const ComputationError& error) {
    message = error.what();
  }
  for (const std::string& other : ranks.gather({message})) EXPECT_EQ(other, message);
  EXPECT_NE(message, "");
}

TEST(SpreadBody, FailsOnAllProcessesWithOneMessageInARefreshOfCrowded_bodies) {
  SolidInputs inputs;
  inputs.ranks = ranks;
  const auto solid = make_solid(elastic(), crowded_points(), SymmetryPlanes{}, inputs);
  std::string message;
  try {
    solid->refresh();
  } catch (const ComputationError& error) {
    message = error.what();
  }
  for (const std::string& other : ranks.gather({message})) EXPECT_EQ(other, message);
  EXPECT_NE(message.find("neighbours"), std::string::npos) << message;
}

} // namespace
} // namespace spall::test

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  spall::test::ranks = spall::Ranks(argc, argv);
  if (!spall::test::ranks.first()) {
    auto& listeners = ::testing::UnitTest::GetInstance()->listeners();
    delete listeners.Release(listeners.default_result_printer());
  }
  const int result = RUN_ALL_TESTS();
  spall::test::ranks = {};
  return result;
}
