// A body spread over the processes that mpirun has started moves as it does in one.

#include "macro/output/checkpoint.h"
#include "macro/output/whole_body.h"
#include "macro/scene_simulation.h"
#include "shared/error.h"
#include "tests/unit/output/small_bar.h"
#include "tests/unit/shared/scratch_folder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <optional>

namespace spall::test {
namespace {

Ranks ranks; // set in main

struct Case {
  std::string name;
  SceneInputs scene{};
  RunInputs numerics{};
  double tolerance = 1e-9; ///< of what round-off has become after all steps
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

/// A quarter of an aluminium bar on a rigid wall.
Case bar(const std::string& name, const std::function<void(RunInputs&)>& change = {}) {
  Case c{.name = name};
  c.scene = small_bar(Boundary::centred, {"x", "y"});
  c.scene.filling = {7, 14, Boundary::centred}; // five blocks: at least one for each of four ranks
  c.scene.contact.friction = 0.1;
  c.numerics.solid.double_precision = true;
  c.numerics.time.verify_every = 50;
  c.numerics.solid.integration.refresh_interval = 7;
  if (change) change(c.numerics);
  return c;
}

Case scheme(const std::string& name, Scheme which) {
  return bar(name, [&](RunInputs& n) { n.solid.integration.scheme = which; });
}

/// The first steps of an ogive through concrete, regions that are quiet left out of refreshes.
Case slab(const std::string& name, bool double_precision, double tolerance) {
  Case c{.name = name, .tolerance = tolerance};
  Parameters parameters;
  c.scene.declare(parameters);
  c.numerics.declare(parameters);
  parameters.read(SPALL_DATA "/scenes/slab_127.prm",
                  {"AFC/Damage table=", "Body/Diameter=0.3 m", "Body/Rings=12", "Body/Layers=8",
                   std::string("Approximation/Double precision=") + (double_precision ? "yes" : "no")});
  c.scene.validate("slab");
  c.numerics.validate("slab");
  c.numerics.time.verify_every = 50;
  return c;
}

std::vector<Case> cases() {
  return {bar("NSNI"),
          bar("NSNI_regions_left_out", [](RunInputs& n) { n.solid.integration.least_deformation = 1e-3; }),
          scheme("SNNI", Scheme::snni),
          scheme("M_SNNI", Scheme::m_snni),
          scheme("sub_points", Scheme::subpoint),
          bar("Lagrangian",
              [](RunInputs& n) { n.solid.approximation.configuration = Configuration::lagrangian; }),
          bar("corrected", [](RunInputs& n) { n.solid.integration.correction = Correction::linear; }),
          bar("damped", [](RunInputs& n) { n.time.gamma = 0.6; }),
          slab("slab", true, 1e-9),
          slab("slab_single_precision", false, 1e-3)};
}

class Spread : public ::testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Bodies, Spread, ::testing::ValuesIn(cases()),
                         [](const auto& instance) { return instance.param.name; });

/// Largest difference of this rank's part from the same part of the whole, in the largest value.
double difference(const VectorField& part, const VectorField& whole, std::size_t first, std::size_t count) {
  double largest = 0, change = 0;
  for (int c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < count; ++i) {
      const double a = part.component[c][i], b = whole.component[c][first + i];
      largest = std::max(largest, std::abs(b)), change = std::max(change, std::abs(a - b));
    }
  return change / ranks.max(largest);
}

TEST_P(Spread, MovesAsItDoesInOneProcess) {
  Case c = GetParam();
  Simulation whole = make_simulation(c.scene, c.numerics);
  c.numerics.solid.ranks = ranks;
  Simulation spread = make_simulation(c.scene, c.numerics);
  const Solid &all = *whole.solids[0], &mine = *spread.solids[0];
  for (int step = 0; step < 200; ++step) whole.advance(), spread.advance();

  const std::size_t n = mine.points.owned, first = mine.ghosts.remote_points().first();
  EXPECT_EQ(ranks.sum(static_cast<double>(n)), static_cast<double>(all.points.owned));
  if (ranks.several()) {
    EXPECT_LT(n, all.points.owned);
    EXPECT_GT(mine.ghosts.remote_points().size(), 0u);
  }
  EXPECT_LT(difference(mine.points.position, all.points.position, first, n), c.tolerance);
  EXPECT_LT(difference(mine.points.velocity, all.points.velocity, first, n), c.tolerance);
  EXPECT_LT(difference(mine.points.force, all.points.force, first, n), 100 * c.tolerance);
  const auto near = [&](double a, double b, double scale) { EXPECT_NEAR(a, b, c.tolerance * scale); };
  const Budget &a = spread.budget, &b = whole.budget;
  near(spread.time, whole.time, whole.time);
  for (const auto member : {&Budget::kinetic, &Budget::body_kinetic, &Budget::stabilization,
                            &Budget::friction, &Budget::contact, &Budget::damping})
    near(a.*member, b.*member, b.initial_energy);
  near(a.internal.total, b.internal.total, b.initial_energy);
  near(a.internal.compression, b.internal.compression, b.initial_energy);
  near(a.impulse, b.impulse, std::abs(b.impulse));
  near(spread.body.velocity[2], whole.body.velocity[2], 1 + std::abs(whole.body.velocity[2]));
  near(spread.momentum_error().linear, whole.momentum_error().linear, 1);
  near(spread.mean_contact_gap(), whole.mean_contact_gap(), whole.mean_contact_gap());
  near(spread.smallest_step_margin, whole.smallest_step_margin, 1);
  near(spread.roughness.position_saw_tooth, whole.roughness.position_saw_tooth, 1);
  near(spread.roughness.plastic_saw_tooth, whole.roughness.plastic_saw_tooth, 1);
  near(spread.roughness.volume_mismatch, whole.roughness.volume_mismatch, 1);
  EXPECT_EQ(spread.refreshes, whole.refreshes);
  EXPECT_EQ(spread.refreshed_points, whole.refreshed_points);
  EXPECT_EQ(spread.most_isolated, whole.most_isolated);
  EXPECT_NE(b.impulse, 0);
}

/// The slab of the cases, over all processes.
Simulation spread_slab() {
  Case c = slab("slab", false, 0);
  c.numerics.solid.ranks = ranks;
  return make_simulation(c.scene, c.numerics);
}

TEST(SpreadBody, GoesOnBitForBitFromACheckpoint_slab) {
  std::optional<ScratchFolder> folder; // one for all
  if (ranks.first()) folder.emplace();
  const std::string path =
      ranks.gather(folder ? std::vector<std::string>{folder->path.string()} : std::vector<std::string>{})
          .front();
  const auto advance = [](Simulation& run) {
    for (int step = 0; step < 40; ++step) run.advance();
  };
  Simulation whole = spread_slab(), resumed = spread_slab();
  advance(whole);
  Checkpoints checkpoints(path, {}, ranks);
  checkpoints.write([&](Archive& archive) { whole.transfer(archive); });
  advance(whole);
  ASSERT_TRUE(checkpoints.find());
  checkpoints.load([&](Archive& archive) { resumed.transfer(archive); });
  EXPECT_EQ(resumed.steps, 40u);
  advance(resumed);
  for (int c = 0; c < 3; ++c) {
    EXPECT_EQ(resumed.solids[0]->points.position.component[c], whole.solids[0]->points.position.component[c]);
    EXPECT_EQ(resumed.solids[0]->points.velocity.component[c], whole.solids[0]->points.velocity.component[c]);
  }
  EXPECT_EQ(resumed.budget.total(), whole.budget.total());
  if (ranks.several()) { // belongs to as many ranks
    ranks.on_first([&] {
      expect_one_line_with(message_of<InputError>([&] { Checkpoints(path, {}).find(); }), {"ranks, not 1"});
    });
  }
}

TEST(SpreadBody, IsGatheredInItsOrder_slab) {
  Simulation spread = spread_slab();
  Case c = slab("slab", false, 0);
  WholeBody body(spread, [&] { return make_simulation(c.scene, c.numerics); });
  for (int gathering = 0; gathering < 2; ++gathering) {
    for (int step = 0; step < 20; ++step) spread.advance();
    body.gather();
  }
  if (!ranks.first()) return;
  const Solid &all = *body.view().solids[0], &mine = *spread.solids[0];
  EXPECT_EQ(all.points.owned, spread.point_count());
  EXPECT_EQ(body.view().budget.total(), spread.budget.total());
  EXPECT_EQ(body.view().steps, spread.steps);
  for (std::size_t i = 0; i < mine.points.owned; ++i)
    EXPECT_EQ(all.points.position[i], mine.points.position[i]);
  const std::vector<double> strain = all.field("plastic_strain"), part = mine.field("plastic_strain");
  EXPECT_TRUE(std::equal(part.begin(), part.end(), strain.begin()));
  double momentum = 0;
  for (std::size_t i = 0; i < all.points.owned; ++i)
    momentum += all.points.mass[i] * all.points.velocity.component[2][i];
  EXPECT_NEAR(momentum, spread.budget.points_momentum, 1e-9 * std::abs(momentum));
}

TEST(SpreadBody, FailsOnAllProcessesWithOneMessage) {
  Case c = bar("unstable", [](RunInputs& n) { n.time.step_factor = 1, n.time.verify_every = 0; });
  c.scene.impact_velocity = 5000;
  c.numerics.solid.ranks = ranks;
  Simulation run = make_simulation(c.scene, c.numerics);
  std::string message;
  try {
    for (int step = 0; step < 2000; ++step) run.advance();
  } catch (const ComputationError& error) {
    message = error.what();
  }
  for (const std::string& other : ranks.gather({message})) EXPECT_EQ(other, message);
  EXPECT_NE(message, "");
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
