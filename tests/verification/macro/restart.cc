// Tests that a run of penetrate that was stopped and restarted ends like an undisturbed one.

#include "tests/verification/macro/program.h"

#include "tests/support/fields.h"

#include <chrono>
#include <random>
#include <thread>

namespace spall::test {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> slab = {SPALL_DATA "/scenes/slab_127.prm",
                                       "AFC/Damage table=",
                                       "slab/Diameter=0.3 m",
                                       "slab/Rings=8",
                                       "slab/Layers=4",
                                       "Time/End time=0.8 ms",
                                       "Output/Frame interval=0.1 ms"};

/// Runs of a few hundred steps.
const std::vector<std::string> short_slab =
    with(slab, {"slab/Rings=12", "slab/Layers=8", "Time/End time=0.3 ms", "Output/Frame interval=0.1 ms"});

void expect_same_results(const Program& whole, const Program& resumed) {
  EXPECT_EQ(resumed.text("out/history.csv"), whole.text("out/history.csv"));
  const Fields a(whole.output), b(resumed.output);
  ASSERT_EQ(b.list("/frames"), a.list("/frames"));
  for (const std::string& frame : a.list("/frames")) {
    EXPECT_EQ(b.real_attribute("/frames/" + frame, "time"), a.real_attribute("/frames/" + frame, "time"));
    for (const std::string body : {"slab", "projectile"})
      for (const std::string& array : a.list("/frames/" + frame + "/" + body)) {
        const std::string path = "/frames/" + frame + "/" + body + "/" + array;
        const std::size_t columns =
            array == "position" || array == "velocity" || array == "displacement" ? 3 : 1;
        EXPECT_EQ(b.read<float>(path, columns), a.read<float>(path, columns)) << path;
      }
  }
  for (const char* answer : {"steps", "simulated_time", "final_velocity", "refreshed_points", "warnings",
                             "energy_balance_error", "plastic_strain_saw_tooth"})
    EXPECT_EQ(resumed.summary().at(answer), whole.summary().at(answer)) << answer;
}

void wait_for(const fs::path& file) {
  for (int n = 0; n < 4000 && !fs::exists(file); ++n)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
}

/// Interrupts a run after some rows, lets it go on, and compares it with an undisturbed one.
void expect_an_interrupt_changes_nothing(const std::vector<std::string>& words) {
  Program whole, resumed;
  ASSERT_EQ(whole.run(words), 0);
  resumed.start(words);
  resumed.wait_for_history(50);
  resumed.send(SIGTERM);
  ASSERT_EQ(resumed.wait(), 130);
  EXPECT_NE(resumed.text("stderr").find("--restart"), std::string::npos) << resumed.text("stderr");
  ASSERT_EQ(resumed.run(with(words, {"--restart"})), 0) << resumed.text("stderr");
  EXPECT_NE(resumed.text("stdout").find("goes on from"), std::string::npos);
  expect_same_results(whole, resumed);
  EXPECT_EQ(resumed.summary().at("restarts"), "1");
}

TEST(Restarted, AfterAnInterruptTheRunEndsLikeAnUndisturbedOne) { expect_an_interrupt_changes_nothing(slab); }

// Steps are longer than this interval at first and shorter later: a run that counted its rows by the interval
// alone was behind by some, and a restart wrote one of them at once.
TEST(Restarted, NoRowIsWrittenTwiceWhereStepsAreLongerThanTheIntervalOfRows) {
  expect_an_interrupt_changes_nothing(
      with(short_slab, {"Output/History interval=1.8 us", "Output/Frame interval=10 us"}));
}

TEST(Restarted, AFullDiskLosesNeitherTheRunNorTheExistingCheckpoint) {
  Program whole, resumed;
  ASSERT_EQ(whole.run(slab), 0);
  resumed.start(slab);
  resumed.wait_for_history(50);
  resumed.interrupt();
  ASSERT_EQ(resumed.wait(), 130);
  const std::string checkpoint = resumed.text("out/checkpoint.h5");
  // The limit has room for history and frames, not for another checkpoint.
  resumed.largest_file = checkpoint.size() - 20000;
  ASSERT_GT(resumed.largest_file, 2 * whole.text("out/history.csv").size());
  ASSERT_EQ(resumed.run(with(slab, {"--restart", "Run/Checkpoint interval=0.02 s"})), 0)
      << resumed.text("stderr");
  EXPECT_NE(resumed.text("stderr").find("no checkpoint"), std::string::npos);
  EXPECT_EQ(resumed.text("out/checkpoint.h5"), checkpoint);
  expect_same_results(whole, resumed);
}

TEST(Restarted, WithoutACheckpointOrWithAnotherInputItIsRefused) {
  Program program;
  program.expect_refused(with(short_slab, {"--restart"}), {"--restart", "does not exist"});
  fs::create_directories(program.output);
  program.expect_refused(with(short_slab, {"--restart"}), {"--restart", "no checkpoint"});
  ASSERT_EQ(program.run(short_slab), 0) << program.text("stderr");
  program.expect_refused(with(short_slab, {"--restart", "Contact/Friction=0.2"}),
                         {"checkpoint.h5", "another input", "set Friction"});
  fs::remove(program.output / "fields" / "000.h5");
  program.expect_refused(with(short_slab, {"--restart", "Time/End time=0.4 ms"}), {"000.h5", "is gone"});
}

TEST(Restarted, AFinishedRunSaysSoAndALaterEndTimeExtendsIt) {
  Program whole, extended;
  ASSERT_EQ(extended.run(with(short_slab, {"Time/End time=0.15 ms"})), 0) << extended.text("stderr");
  const auto before = extended.results();
  ASSERT_EQ(extended.run(with(short_slab, {"Time/End time=0.15 ms", "--restart"})), 0);
  EXPECT_NE(extended.text("stdout").find("is finished"), std::string::npos) << extended.text("stdout");
  EXPECT_TRUE(extended.results() == before);
  ASSERT_EQ(extended.run(with(short_slab, {"--restart"})), 0) << extended.text("stderr");
  ASSERT_EQ(whole.run(short_slab), 0);
  expect_same_results(whole, extended);
  EXPECT_FALSE(fs::exists(extended.output / "summary_previous.json"));
}

/// A run whose velocity has settled long before its tail has left.
const std::vector<std::string> passing = {SPALL_DATA "/scenes/slab_127_u.prm",
                                          "slab/Diameter=0.5 m",
                                          "slab/Rings=10",
                                          "slab/Layers=5",
                                          "Run/Until=settled",
                                          "Output/Frame interval=0.3 ms"};

TEST(Restarted, AfterAnInterruptARunEndsWhereItsAnswersSettle) {
  expect_an_interrupt_changes_nothing(passing);
}

TEST(Restarted, ARunThatHasSettledSaysSoAndGoesOnForItsCraters) {
  Program whole, extended;
  ASSERT_EQ(extended.run(passing), 0) << extended.text("stderr");
  EXPECT_EQ(extended.summary().at("ended"), "\"finished\"");
  EXPECT_EQ(extended.summary().at("back_crater_diameter"), "null");
  EXPECT_FALSE(fs::exists(extended.output / "craters.csv"));
  EXPECT_NE(extended.text("stdout").find("settled: exit velocity; not settled: craters"), std::string::npos);
  const double settled = std::stod(extended.summary().at("exit_velocity"));
  ASSERT_EQ(extended.run(with(passing, {"--restart"})), 0);
  EXPECT_NE(extended.text("stdout").find("is finished"), std::string::npos);
  EXPECT_NE(extended.text("stdout").find("Run/Until = answered or end time extends it"), std::string::npos);
  ASSERT_EQ(extended.run(with(passing, {"--restart", "Run/Until=answered"})), 0) << extended.text("stderr");
  ASSERT_EQ(whole.run(with(passing, {"Run/Until=answered"})), 0) << whole.text("stderr");
  expect_same_results(whole, extended);
  EXPECT_EQ(extended.text("out/craters.csv"), whole.text("out/craters.csv"));
  for (const char* key : {"exit_velocity", "time_of_exit", "back_crater_diameter", "debris_mass"})
    EXPECT_EQ(extended.summary().at(key), whole.summary().at(key)) << key;
  EXPECT_NEAR(settled, std::stod(whole.summary().at("exit_velocity")), 1e-3 * settled);
  // The state of the tail's exit goes on as well, to any end time.
  const double out = std::stod(whole.summary().at("simulated_time"));
  ASSERT_EQ(extended.run(with(passing, {"--restart", "Run/Until=end time", "Time/End time=3 ms"})), 0);
  EXPECT_GT(std::stod(extended.summary().at("simulated_time")), out);
  EXPECT_EQ(extended.summary().at("exit_velocity"), whole.summary().at("exit_velocity"));
}

TEST(RestartedOverRanks, ARunSettlesOnTwoRanksAsOnOne) {
  const auto words = with(passing, {"Approximation/Double precision=yes"});
  Program one, two;
  two.processes = 2;
  ASSERT_EQ(one.run(words), 0) << one.text("stderr");
  ASSERT_EQ(two.run(words), 0) << two.text("stderr");
  EXPECT_EQ(two.summary().at("steps"), one.summary().at("steps"));
  EXPECT_EQ(two.summary().at("settled"), "\"exit velocity\"");
  const double velocity = std::stod(one.summary().at("exit_velocity"));
  EXPECT_NEAR(std::stod(two.summary().at("exit_velocity")), velocity, 1e-8 * velocity);
}

TEST(Restarted, ARunThatWasKilledBeforeItsAnswersGetsThem) {
  Program program;
  ASSERT_EQ(program.run(short_slab), 0) << program.text("stderr");
  const auto summary = program.summary();
  const std::string history = program.text("out/history.csv");
  fs::remove(program.output / "summary.json"); // the checkpoint is written before it
  ASSERT_EQ(program.run(with(short_slab, {"--restart"})), 0) << program.text("stderr");
  for (const char* key : {"final_velocity", "back_crater_diameter", "ended", "steps"})
    EXPECT_EQ(program.summary().at(key), summary.at(key)) << key;
  EXPECT_EQ(program.text("out/history.csv"), history);
}

/// Starts a run again and again and kills it at random moments, the first time after a checkpoint.
void expect_survives(int kills, const std::vector<std::string>& words) {
  Program whole, resumed;
  ASSERT_EQ(whole.run(words), 0);
  std::mt19937 engine(7);
  std::uniform_int_distribution<int> milliseconds(20, 300);
  int killed = 0;
  for (int n = 0; n < kills; ++n) {
    resumed.start(with(words, {fs::exists(resumed.output / "checkpoint.h5") ? "--restart" : "--force"}));
    wait_for(resumed.output / "checkpoint.h5"); // without one it could not go on
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds(engine)));
    resumed.send(SIGKILL);
    killed += resumed.wait() ==
              -SIGKILL; // otherwise it ended before, and the next start continues from its last checkpoint
  }
  EXPECT_GE(killed, kills / 2);
  ASSERT_EQ(resumed.run(with(words, {"--restart"})), 0) << resumed.text("stderr");
  expect_same_results(whole, resumed);
}

TEST(Restarted, KilledTwiceTheRunEndsLikeAnUndisturbedOne) {
  expect_survives(2, with(slab, {"Run/Checkpoint interval=0.05 s"}));
}

TEST(RestartedOverRanks, AfterOneRankWasKilledTheRunEndsAsIfNothingHadHappened) {
  // Points that move between the ranks change the order of sums, and they move by measured times: off.
  const auto words = with(short_slab, {"Run/Rebalance tolerance=0"});
  Program whole, resumed;
  whole.processes = resumed.processes = 2;
  ASSERT_EQ(whole.run(words), 0) << whole.text("stderr");
  resumed.start(with(words, {"Run/Checkpoint interval=0.05 s"}));
  wait_for(resumed.output / "checkpoint.h5");
  resumed.wait_for_history(10);
  resumed.send_to_one(SIGKILL);
  EXPECT_NE(resumed.wait(), 0);
  EXPECT_NE(resumed.text("stderr").find("signal 9"), std::string::npos) << resumed.text("stderr");
  EXPECT_NE(resumed.text("stdout").find("--restart"), std::string::npos) << resumed.text("stdout");
  ASSERT_EQ(resumed.run(with(words, {"--restart"})), 0) << resumed.text("stderr");
  EXPECT_NE(resumed.text("stdout").find("goes on from"), std::string::npos);
  expect_same_results(whole, resumed);
}

/// Parameter: numbers of processes before and after the restart.
class RestartedOnOthers : public ::testing::TestWithParam<std::pair<int, int>> {};
INSTANTIATE_TEST_SUITE_P(RestartedOverRanks, RestartedOnOthers,
                         ::testing::Values(std::pair{1, 2}, std::pair{2, 1}, std::pair{3, 2}),
                         [](const auto& instance) {
                           return std::to_string(instance.param.first) + "_to_" +
                                  std::to_string(instance.param.second);
                         });

TEST_P(RestartedOnOthers, TheRunEndsAsTheUndisturbedOneWithinRoundOff) {
  const auto words = with(short_slab, {"Approximation/Double precision=yes", "AFC/T_max=1 GPa",
                                       "AFC/Crack model=isotropic"}); // no cracks: see scheme_cases.h
  Program whole, resumed;
  ASSERT_EQ(whole.run(words), 0) << whole.text("stderr");
  resumed.processes = GetParam().first;
  ASSERT_EQ(resumed.run(with(words, {"Time/End time=0.1 ms", "Run/Checkpoint interval=0.01 s"})), 0)
      << resumed.text("stderr");
  resumed.processes = GetParam().second;
  ASSERT_EQ(resumed.run(with(words, {"--restart"})), 0) << resumed.text("stderr");
  EXPECT_NE(resumed.text("stdout").find("goes on from"), std::string::npos);
  const auto [names, expected] = whole.history();
  const auto rows = resumed.history().second;
  ASSERT_EQ(resumed.summary().at("steps"), whole.summary().at("steps"));
  EXPECT_GT(std::stod(whole.summary().at("steps")), 150);
  for (std::size_t c = 0; c < names.size(); ++c) {
    double largest = 1e-9;
    for (const auto& row : expected) largest = std::max(largest, std::abs(row[c]));
    EXPECT_NEAR(rows.back()[c], expected.back()[c], 1e-8 * largest) << names[c];
  }
}

/// This test has the label long.
TEST(RestartedOften, KilledAtTenRandomMomentsTheRunEndsLikeAnUndisturbedOne) {
  expect_survives(10, with(slab, {"slab/Rings=12", "slab/Layers=8", "Time/End time=2 ms",
                                  "Run/Checkpoint interval=0.1 s"}));
}

} // namespace
} // namespace spall::test
