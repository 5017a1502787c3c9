// A body spread over the processes that mpirun has started moves as it does in one.

#include "macro/output/answers.h"
#include "macro/output/checkpoint.h"
#include "macro/output/frames.h"
#include "macro/rebalance.h"
#include "shared/error.h"
#include "shared/hdf5_file.h"
#include "shared/traffic.h"
#include "tests/unit/shared/scratch_folder.h"
#include "tests/verification/macro/scheme_cases.h"

#include <gtest/gtest.h>

#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <functional>
#include <optional>
#include <regex>

namespace spall::test {
namespace {

Ranks ranks; // set in main

/// A folder for all ranks, empty at first.
class SharedFolder {
public:
  SharedFolder() {
    if (ranks.first()) own.emplace();
    path =
        ranks.gather(own ? std::vector<std::string>{own->path.string()} : std::vector<std::string>{}).front();
  }
  ~SharedFolder() { ranks.any(false); } // not before all have done with it

  std::filesystem::path path;

private:
  std::optional<ScratchFolder> own;
};

class Spread : public ::testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Bodies, Spread, ::testing::ValuesIn(scheme_cases()),
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

/// The points that this rank has of a body against those of the whole.
void expect_same_points(const Solid& mine, const Solid& all, double tolerance) {
  const std::size_t n = mine.points.owned, first = mine.ghosts.remote_points().first();
  EXPECT_EQ(ranks.sum(static_cast<double>(n)), static_cast<double>(all.points.owned));
  EXPECT_LT(difference(mine.points.position, all.points.position, first, n), tolerance) << mine.label;
  EXPECT_LT(difference(mine.points.velocity, all.points.velocity, first, n), tolerance) << mine.label;
  EXPECT_LT(difference(mine.points.force, all.points.force, first, n), 100 * tolerance) << mine.label;
}

void expect_same_run(const Simulation& whole, const Simulation& spread, const Case& c) {
  for (std::size_t b = 0; b < whole.solids.size(); ++b)
    expect_same_points(*spread.solids[b], *whole.solids[b], c.tolerance);
  const auto near = [&](double a, double b, double scale) { EXPECT_NEAR(a, b, c.tolerance * scale); };
  const Budget &a = spread.budget, &b = whole.budget;
  near(spread.time, whole.time, whole.time);
  for (const auto member : {&Budget::kinetic, &Budget::body_kinetic, &Budget::stabilization,
                            &Budget::friction, &Budget::contact, &Budget::damping, &Budget::culvert})
    near(a.*member, b.*member, b.initial_energy);
  near(a.internal.total, b.internal.total, b.initial_energy);
  near(a.internal.compression, b.internal.compression, b.initial_energy);
  near(a.impulse, b.impulse, std::abs(b.impulse));
  for (std::size_t k = 0; k < whole.solids.size(); ++k) {
    near(a.solid_momentum[k], b.solid_momentum[k], std::abs(b.initial_momentum));
    near(spread.solid_work[k], whole.solid_work[k], b.initial_energy);
    near(spread.given_by_first[k][2], whole.given_by_first[k][2], std::abs(b.initial_momentum));
  }
  if (c.scene.kind == SceneKind::slab) {
    const ProjectileState one = projectile_of(whole), many = projectile_of(spread);
    near(many.front, one.front, 1), near(many.rear, one.rear, 1), near(many.speed(), one.speed(), 100);
  }
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
  const Vec3 met = whole.solids.size() > 1 ? whole.given_by_first[1] : Vec3{};
  EXPECT_TRUE(b.impulse != 0 || met[2] != 0);
}

/// Both runs of a case, of 200 steps. `between` is done to the spread one after every step.
void run_both(Case c, const std::function<void(Simulation&)>& between = {}) {
  Simulation whole = make_simulation(c.scene, c.numerics);
  c.numerics.solid.ranks = ranks;
  Simulation spread = make_simulation(c.scene, c.numerics);
  for (int step = 0; step < 200; ++step) {
    whole.advance(), spread.advance();
    if (between) between(spread);
  }
  if (ranks.several() && !between) {
    const Solid& mine = *spread.solids[0];
    EXPECT_LT(mine.points.owned, whole.solids[0]->points.owned);
    EXPECT_GT(ranks.sum(static_cast<double>(mine.ghosts.remote_points().size())), 0);
  }
  expect_same_run(whole, spread, c);
}

TEST_P(Spread, MovesAsItDoesInOneProcess) { run_both(GetParam()); }

TEST_P(Spread, MovesAsItDoesInOneProcessWhenPointsGoToOtherRanks) {
  run_both(GetParam(), [](Simulation& run) {
    // Few points on the first ranks, or none, then few on the last.
    if (run.steps != 40 && run.steps != 110) return;
    const auto count = static_cast<std::uint64_t>(ranks.count());
    std::vector<std::vector<std::uint64_t>> cuts(run.solids.size());
    for (std::size_t s = 0; s < run.solids.size(); ++s) {
      const std::uint64_t all = ranks.share(run.solids[s]->points.owned).all,
                          blocks = (all + block_size - 1) / block_size;
      for (std::uint64_t r = 0; r <= count; ++r) {
        const std::uint64_t k = run.steps == 40 ? r : count - r, part = blocks * k * k / (count * count);
        cuts[s].push_back(run.steps == 40 ? part : blocks - part);
      }
    }
    move_points(run, cuts);
  });
}

/// A whole run in the default precision, in which points go where they are cheapest.
Simulation run_to_its_end(Case c, const Ranks& of, const std::function<bool(const Simulation&)>& done) {
  c.numerics.solid.double_precision = false;
  c.numerics.solid.ranks = of;
  Simulation run = make_simulation(c.scene, c.numerics);
  Balancer balancer(c.numerics.balance);
  while (!done(run) && run.time < c.numerics.time.end_time) run.advance(), balancer.look(run);
  EXPECT_TRUE(done(run));
  return run;
}

TEST(SpreadToTheEnd, TheProjectileLeavesTheSlabAsItDoesInOneProcess) {
  const Case c = slab("slab", false, 0);
  const auto out = [](const Simulation& run) { return run.exit.happened(); };
  const double alone = run_to_its_end(c, {}, out).exit.speed,
               spread = run_to_its_end(c, ranks, out).exit.speed;
  EXPECT_NEAR(spread, alone, 1e-3 * alone);
}

TEST(SpreadToTheEnd, TheBarIsAsShortAsItIsInOneProcess) {
  const Case c = bar("bar", [](RunInputs& n) { n.time.end_time = 1e-3; });
  const auto rebounds = [](const Simulation& run) { return run.budget.solid_momentum[0] >= 0; };
  const auto length = [&](const Ranks& of) {
    const Simulation run = run_to_its_end(c, of, rebounds);
    const std::vector<double>& z = run.solids[0]->points.position.component[2];
    double low = 1e300, high = -1e300;
    for (std::size_t i = 0; i < run.solids[0]->points.owned; ++i)
      low = std::min(low, z[i]), high = std::max(high, z[i]);
    return of.max(high) - of.min(low);
  };
  const double alone = length({});
  EXPECT_NEAR(length(ranks), alone, 1e-3 * alone);
}

/// A run that is spread over the ranks against one on the first rank alone.
void expect_same(const Simulation& spread, const Simulation& alone, double tolerance) {
  for (std::size_t b = 0; b < spread.solids.size(); ++b) {
    const Points &mine = spread.solids[b]->points, &all = alone.solids[b]->points;
    for (int c = 0; c < 3; ++c) {
      const std::vector<double>& x = mine.position.component[c];
      const std::vector<double> joined =
          ranks.join(std::vector<double>(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(mine.owned)));
      for (std::size_t i = 0; i < all.owned && ranks.first(); ++i)
        ASSERT_NEAR(joined[i], all.position.component[c][i], 0.1 * tolerance) << spread.solids[b]->label;
    }
  }
  if (!ranks.first()) return;
  EXPECT_EQ(spread.steps, alone.steps);
  EXPECT_NEAR(spread.budget.total(), alone.budget.total(), tolerance * alone.budget.initial_energy);
  EXPECT_NEAR(spread.budget.momentum, alone.budget.momentum,
              tolerance * std::abs(alone.budget.initial_momentum));
}

TEST_P(Spread, GoesOnOnAnotherNumberOfProcesses) {
  const SharedFolder folder;
  Case c = GetParam(), d = c;
  d.numerics.solid.ranks = ranks;
  const auto advance = [](Simulation& run) {
    for (int step = 0; step < 40; ++step) run.advance();
  };
  Simulation spread = make_simulation(d.scene, d.numerics), alone = make_simulation(c.scene, c.numerics);
  advance(spread);
  Checkpoints together(folder.path, {}, ranks), own(folder.path, {});
  together.write([&](Archive& archive) { spread.transfer(archive); });
  if (ranks.first()) {
    ASSERT_TRUE(own.find());
    own.load([&](Archive& archive) { alone.transfer(archive); });
    advance(alone);
  }
  advance(spread);
  expect_same(spread, alone, c.tolerance);
  // And back.
  Simulation resumed = make_simulation(d.scene, d.numerics);
  ranks.on_first([&] { own.write([&](Archive& archive) { alone.transfer(archive); }); });
  ASSERT_TRUE(together.find());
  together.load([&](Archive& archive) { resumed.transfer(archive); });
  advance(resumed);
  if (ranks.first()) advance(alone);
  expect_same(resumed, alone, c.tolerance);
}

/// The slab of the cases, over all processes.
Simulation spread_slab() {
  Case c = slab("slab", false, 0);
  c.numerics.solid.ranks = ranks;
  return make_simulation(c.scene, c.numerics);
}

TEST(SpreadBody, GoesOnBitForBitFromACheckpoint_slab) {
  const SharedFolder folder;
  const auto advance = [](Simulation& run) {
    for (int step = 0; step < 40; ++step) run.advance();
  };
  Simulation whole = spread_slab(), resumed = spread_slab();
  advance(whole);
  Checkpoints checkpoints(folder.path, {}, ranks);
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
}

/// No file may be larger while this is there, as if the disk were full.
class SmallDisk {
public:
  explicit SmallDisk(std::size_t bytes) {
    getrlimit(RLIMIT_FSIZE, &before);
    const rlimit small{bytes, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
    handler = std::signal(SIGXFSZ, SIG_IGN);
  }
  ~SmallDisk() {
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
  }

private:
  rlimit before{};
  void (*handler)(int);
};

TEST(SpreadBody, AFullDiskLosesNoCheckpointThatIsThere_slab) {
  const SharedFolder folder;
  Simulation run = spread_slab();
  const auto state = [&](Archive& archive) { run.transfer(archive); };
  run.advance();
  Checkpoints checkpoints(folder.path, {}, ranks);
  checkpoints.write(state);
  const std::string before = read_text(folder.path / "checkpoint.h5");
  run.advance();
  {
    const SmallDisk full(before.size() / 2);
    const std::string message = message_of<ComputationError>([&] { checkpoints.write(state); });
    EXPECT_NE(message.find("checkpoint.h5"), std::string::npos) << message;
  }
  EXPECT_EQ(read_text(folder.path / "checkpoint.h5"), before);
  if (ranks.first()) {
    EXPECT_FALSE(std::filesystem::exists(folder.path / "checkpoint.h5.part"));
  }
  checkpoints.write(state);
  Simulation resumed = spread_slab();
  ASSERT_TRUE(checkpoints.find());
  checkpoints.load([&](Archive& archive) { resumed.transfer(archive); });
  EXPECT_EQ(resumed.steps, 2u);
}

/// All arrays of two files of fields, those of the second within round-off.
void expect_same_fields(const std::filesystem::path& one, const std::filesystem::path& other) {
  const Hdf5File a(one / "fields.h5", Hdf5File::Mode::read), b(other / "fields.h5", Hdf5File::Mode::read);
  ASSERT_EQ(a.list("/"), b.list("/"));
  EXPECT_EQ(a.read<float>("/initial_position", 3), b.read<float>("/initial_position", 3));
  EXPECT_EQ(a.read<float>("/volume"), b.read<float>("/volume"));
  ASSERT_EQ(a.list("/frames"), b.list("/frames"));
  for (const std::string& frame : a.list("/frames")) {
    const std::string group = "/frames/" + frame;
    ASSERT_EQ(a.list(group), b.list(group));
    for (const std::string& array : a.list(group)) {
      const std::size_t columns = array == "position" || array == "velocity" ? 3 : 1;
      const auto x = a.read<float>(group + "/" + array, columns),
                 y = b.read<float>(group + "/" + array, columns);
      ASSERT_EQ(x.size(), y.size());
      float largest = 0;
      for (const float value : x) largest = std::max(largest, std::abs(value));
      for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(x[i], y[i], 1e-5f * largest) << array;
    }
  }
  const auto text = [](const std::filesystem::path& folder) { return read_text(folder / "fields.xdmf"); };
  std::string first = text(one), second = text(other);
  const auto without_times = [](std::string all) {
    return std::regex_replace(all, std::regex("Time Value=\"[^\"]*\""), "");
  };
  EXPECT_EQ(without_times(first), without_times(second));
}

TEST(SpreadBody, WritesTheFilesOfOneProcess_slab) {
  const SharedFolder folder;
  Case c = slab("slab", true, 0);
  Simulation whole = make_simulation(c.scene, c.numerics);
  c.numerics.solid.ranks = ranks;
  Simulation spread = make_simulation(c.scene, c.numerics);
  Frames together(folder.path / "spread", spread, "slab", c.scene.height, {}, false, FragmentInputs{});
  std::optional<Frames> alone;
  if (ranks.first())
    alone.emplace(folder.path / "whole", whole, "slab", c.scene.height, Provenance{}, false,
                  FragmentInputs{});
  for (int frame = 0; frame < 3; ++frame) {
    together.write(spread);
    if (alone) alone->write(whole);
    for (int step = 0; step < 40; ++step) spread.advance(), whole.advance();
  }
  if (ranks.first()) expect_same_fields(folder.path / "whole", folder.path / "spread");
}

/// Breaks a slab into bricks of 30 mm, some of which hold together over their edges.
void break_up(Solid& solid) {
  Points& points = solid.points;
  for (std::size_t i = 0; i < points.owned; ++i) {
    const Vec3 x = points.initial_position[i];
    const auto brick = [&](int c) { return static_cast<int>(std::abs(x[c]) / 30e-3); };
    const int kind = (brick(0) + 3 * brick(1) + brick(2)) % 5;
    points.position.set(i, add(points.position[i], kind * points.spacing[i], {0.1, 0.1, 0.4}));
    points.velocity.set(i, {0, 0, 10.0 * (kind - 1)});
  }
  solid.ghosts.refresh(points);
}

TEST(SpreadBody, HasTheAnswersOfOneProcess_slab) {
  Case c = slab("slab", true, 0);
  Simulation whole = make_simulation(c.scene, c.numerics);
  c.numerics.solid.ranks = ranks;
  Simulation spread = make_simulation(c.scene, c.numerics);
  for (int step = 0; step < 2; ++step) spread.advance(), whole.advance();
  break_up(*whole.solids[0]), break_up(*spread.solids[0]);
  const Perforation a = measure_perforation(whole, c.scene, {}), b = measure_perforation(spread, c.scene, {});
  ASSERT_GT(a.fragments.list.size(), 5u);
  ASSERT_EQ(b.fragments.list.size(), a.fragments.list.size());
  for (std::size_t f = 0; f < a.fragments.list.size(); ++f) {
    const Fragment &x = a.fragments.list[f], &y = b.fragments.list[f];
    EXPECT_EQ(y.place, x.place);
    EXPECT_EQ(y.copies, x.copies);
    EXPECT_EQ(y.points, x.points);
    EXPECT_NEAR(y.mass, x.mass, 1e-12 * x.mass);
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(y.centre[axis], x.centre[axis], 1e-9);
    EXPECT_NEAR(y.velocity[2], x.velocity[2], 1e-9);
  }
  EXPECT_EQ(b.fragments.modelled_points, a.fragments.modelled_points);
  const std::size_t first = spread.solids[0]->ghosts.remote_points().first();
  for (std::size_t i = 0; i < b.fragments.of_point.size(); ++i)
    EXPECT_EQ(b.fragments.of_point[i], a.fragments.of_point[first + i]);
  ASSERT_GT(a.craters.back.mean_diameter, 0);
  EXPECT_EQ(b.craters.radius, a.craters.radius);
  EXPECT_EQ(b.craters.back.outline, a.craters.back.outline);
  EXPECT_EQ(b.craters.front.depth, a.craters.front.depth);
}

TEST(SpreadBody, HasTheShapeOfOneProcess) {
  Case c = bar("bar");
  Simulation whole = make_simulation(c.scene, c.numerics);
  c.numerics.solid.ranks = ranks;
  Simulation spread = make_simulation(c.scene, c.numerics);
  for (int step = 0; step < 100; ++step) spread.advance(), whole.advance();
  const BarShape a = measure_bar(*whole.solids[0], c.scene), b = measure_bar(*spread.solids[0], c.scene);
  EXPECT_NEAR(b.length, a.length, 1e-9 * a.length);
  EXPECT_NEAR(b.foot_diameter, a.foot_diameter, 1e-9 * a.foot_diameter);
  EXPECT_GT(a.plastic_strain_95, a.mean_plastic_strain);
  EXPECT_NEAR(b.plastic_strain_95, a.plastic_strain_95, 1e-7);
  EXPECT_NEAR(b.mean_plastic_strain, a.mean_plastic_strain, 1e-7);
  EXPECT_NEAR(b.max_plastic_strain, a.max_plastic_strain, 1e-7);
}

/// What all ranks have sent for a use since `before` was asked for.
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
  // Between refreshes remote points stay the same: those that receive know what must have been sent.
  double remote = static_cast<double>(run.solids[0]->ghosts.remote_points().size());
  ranks.reduce({.sums = {&remote}});
  const std::array<MpiUse, 3> uses = {MpiUse::velocities, MpiUse::forces, MpiUse::reductions};
  std::vector<Sent> before(uses.begin(), uses.end());
  const std::size_t refreshes = run.refreshes;
  constexpr int steps = 3;
  for (int step = 0; step < steps; ++step) run.advance();
  ASSERT_EQ(run.refreshes, refreshes);
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
