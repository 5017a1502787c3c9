// What penetrate has computed stays: nothing is lost or replaced unasked, and every write is checked.

#include "tests/verification/macro/program.h"

#include "tests/unit/shared/sample_table.h"

namespace spall::test {
namespace {

namespace fs = std::filesystem;

const std::string axis = SPALL_DATA "/scenes/slab_127_axis.prm";
/// A slab around the axis, of a few hundred points and steps.
const std::vector<std::string> tiny = {axis,
                                       "slab/Diameter=0.6 m",
                                       "slab/Fine spacing=21 mm",
                                       "slab/Coarse spacing=21 mm",
                                       "Time/Subcycles=1",
                                       "Time/End time=40 us",
                                       "Output/Frame interval=20 us"};

TEST(Kept, ResultsAreNotReplacedUnlessForced) {
  Program program;
  ASSERT_EQ(program.run(tiny), 0) << program.text("stderr");
  program.expect_refused(tiny, {"holds results", "--force"});
  program.expect_refused(with(tiny, {"Contact/Friction=0.2"}), {"holds results", "--force"});
  // One result alone is enough.
  fs::remove_all(program.output / "fields");
  for (const char* name : {"summary.json", "history.csv", "fields.h5", "fields.xdmf", "resolved.prm",
                           "craters.csv", "crater_profiles.csv", "debris_cone.csv", "fragments.csv"})
    fs::remove(program.output / name);
  program.expect_refused(tiny, {"holds results", "checkpoint.h5"});
  ASSERT_EQ(program.run(with(tiny, {"--force"})), 0) << program.text("stderr");
  EXPECT_EQ(program.summary().at("ended"), "\"end time\"");
}

TEST(Kept, AForcedRunLeavesNothingOfTheOneBefore) {
  Program program;
  ASSERT_EQ(program.run(tiny), 0) << program.text("stderr");
  ASSERT_TRUE(fs::exists(program.output / "craters.csv"));
  ASSERT_EQ(program.run(with(tiny, {"--force", "Answers/Exit=", "Time/End time=10 us"})), 0);
  EXPECT_FALSE(fs::exists(program.output / "craters.csv"));
  EXPECT_FALSE(fs::exists(program.output / "checkpoint_previous.h5"));
  EXPECT_FALSE(fs::exists(program.output / "fields" / "002.h5"));
}

TEST(Kept, AnInputIsNotReplacedEvenIfForced) {
  Program program;
  ASSERT_EQ(program.run(tiny), 0) << program.text("stderr");
  const std::string input = (program.output / "resolved.prm").string();
  program.expect_refused({input, "--force"}, {"the input", "resolved.prm"});
  program.expect_refused({input, "--force", "--restart"}, {"--restart", "--force"});
  EXPECT_EQ(program.run({input, "--restart"}), 0) << program.text("stderr");
}

TEST(Kept, TheFolderIsNamedAfterTheInput) {
  Program program;
  program.directory = program.folder.path;
  const std::string input = program.folder.write("mine.prm", "include " + axis + "\n");
  ASSERT_EQ(program.run_without_output(with({input}, {tiny.begin() + 1, tiny.end()})), 0)
      << program.text("stderr");
  EXPECT_TRUE(fs::exists(program.folder / "out" / "mine" / "summary.json"));
}

/// A run that another one must not disturb, on one process and on two.
class Owner : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Kept, Owner, ::testing::Values(1, 2));

TEST_P(Owner, OfAFolderIsOneRunAtATime) {
  const auto words = with(tiny, {"Time/End time=20 ms", "Run/Until=end time", "Output/Frame interval=1 ms",
                                 "Output/History interval=1 us"});
  Program owner, other;
  owner.processes = GetParam();
  owner.start(words);
  owner.wait_for_history(5);
  other.output = owner.output;
  for (const std::vector<std::string>& more : {std::vector<std::string>{}, {"--force"}, {"--restart"}}) {
    EXPECT_EQ(other.run(with(words, more)), 2);
    EXPECT_EQ(other.lines("stderr"), 1u) << other.text("stderr");
    EXPECT_NE(other.text("stderr").find("belongs to another run"), std::string::npos) << other.text("stderr");
    EXPECT_EQ(other.text("stdout"), "");
  }
  // The lock goes with the process, however that ends.
  if (owner.processes == 1)
    owner.send(SIGKILL);
  else
    owner.interrupt();
  owner.wait();
  EXPECT_EQ(other.run(with(tiny, {"--force"})), 0) << other.text("stderr");
}

TEST(Kept, ATargetWithAHoleOnTheAxisHasItsAnswersFromTheFirstStepOn) {
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{}, {"projectile/Velocity=0 m/s", "Answers/Exit="}}) {
    Program program;
    ASSERT_EQ(program.run(with(with({axis}, {"slab/Hole diameter=40 mm", "Time/End time=5 us"}), more)), 0)
        << program.text("stderr");
    EXPECT_EQ(program.summary().at("ended"), "\"end time\"");
    EXPECT_TRUE(fs::exists(program.output / "checkpoint.h5"));
    if (!more.empty()) continue;
    EXPECT_EQ(program.summary().at("back_crater_diameter"), "0");
    EXPECT_EQ(program.summary().at("exit_velocity"), "null");
  }
}

TEST(Kept, AHistoryThatTheDiskDoesNotTakeEndsWithAWholeRow) {
  Program program;
  program.largest_file = 400000; // history takes more, everything else less
  EXPECT_EQ(program.run(with(tiny, {"slab/Diameter=0.3 m", "Time/End time=10 ms", "Run/Until=end time",
                                    "Output/Frame interval=10 ms", "Output/History interval=0.1 us"})),
            3)
      << program.text("stdout");
  EXPECT_NE(program.text("stderr").find("history.csv"), std::string::npos) << program.text("stderr");
  const auto [names, rows] = program.history();
  EXPECT_EQ(program.text("out/history.csv").back(), '\n');
  EXPECT_GT(rows.size(), 100u);
  EXPECT_EQ(rows.back().size(), names.size());
  EXPECT_EQ(program.summary().at("ended").substr(0, 7), "\"failed");
  // With room again it goes on, and has every row.
  const std::size_t before = rows.size();
  program.largest_file = 0;
  ASSERT_EQ(
      program.run(with(tiny, {"slab/Diameter=0.3 m", "Time/End time=10 ms", "Run/Until=end time",
                              "Output/Frame interval=10 ms", "Output/History interval=0.1 us", "--restart"})),
      0)
      << program.text("stderr");
  const auto all = program.history().second;
  EXPECT_GT(all.size(), before);
  for (std::size_t i = 2; i < before + 5; ++i)
    EXPECT_LT(all[i][0] - all[i - 1][0], 5 * (all[2][0] - all[1][0])) << i;
}

TEST(Kept, WordsThatStandardOutputDoesNotTakeAreCodeThreeAndTheRunIsThere) {
  Program program;
  program.full_stdout = true;
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"--help"}, with(tiny, {"--plan"}), tiny}) {
    EXPECT_EQ(program.run(words), 3);
    EXPECT_NE(program.text("stderr").find("standard output could not be written"), std::string::npos);
  }
  EXPECT_EQ(program.summary().at("ended"), "\"end time\"");
}

TEST(Kept, WordsGoIntoNoFileIfStandardOutputIsClosed) {
  Program open, closed;
  closed.stdout_closed = true;
  ASSERT_EQ(open.run(tiny), 0) << open.text("stderr");
  ASSERT_EQ(closed.run(tiny), 0) << closed.text("stderr");
  for (const char* name : {"out/history.csv", "out/craters.csv", "out/fields.xdmf", "out/resolved.prm"})
    EXPECT_EQ(closed.text(name), open.text(name)) << name;
}

TEST(Kept, TheResolvedInputRepeatsTheRunBitForBitFromAnyFolder) {
  Program first, second;
  first.directory = first.folder.path;
  fs::create_directories(first.folder / "tables");
  write_damage_table(cracking_bar({0.03}), first.folder / "tables/t.h5");
  const std::string scene = first.folder.write(
      "scenes/s.prm", "include " + axis +
                          "\nsubsection slab\n  subsection AFC\n    set Damage table = ../tables/t.h5\n"
                          "  end\nend\n");
  for (const std::vector<std::string>& words :
       {with({scene}, {tiny.begin() + 1, tiny.end()}),
        with(tiny, {"slab/AFC/Damage table=tables/t.h5", "--force"}),
        std::vector<std::string>{SPALL_DATA "/scenes/taylor_aluminium.prm", "bar/Rings=3", "bar/Layers=10",
                                 "Time/End time=5 us", "--force"}}) {
    ASSERT_EQ(first.run(words), 0) << first.text("stderr");
    const std::string copy = second.folder.write("far/away/again.prm", first.text("out/resolved.prm"));
    second.directory = second.folder / "far";
    ASSERT_EQ(second.run({copy, "--force"}), 0) << second.text("stderr");
    EXPECT_EQ(second.text("out/history.csv"), first.text("out/history.csv"));
    EXPECT_GT(first.lines("out/history.csv"), 10u);
    EXPECT_EQ(second.text("out/resolved.prm"), first.text("out/resolved.prm"));
  }
}

} // namespace
} // namespace spall::test
