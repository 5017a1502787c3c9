// Tests of the program penetrate as a process: its files, the inputs that it refuses, and its exit codes.

#include "tests/verification/macro/program.h"

#include "tests/support/fields.h"
#include "tests/unit/shared/sample_table.h"

#include <chrono>
#include <cmath>
#include <thread>

namespace spall::test {
namespace {

const std::string taylor = SPALL_DATA "/scenes/taylor_aluminium.prm",
                  slab = SPALL_DATA "/scenes/slab_127.prm";
const std::vector<std::string> tiny_taylor = {taylor, "bar/Rings=3", "bar/Layers=10", "Time/End time=5 us"};
const std::vector<std::string> tiny_slab = {slab,
                                            "slab/Diameter=0.3 m",
                                            "slab/Rings=8",
                                            "slab/Layers=4",
                                            "Time/End time=0.1 ms",
                                            "Output/Frame interval=0.05 ms"};

void expect_common_results(const Program& program) {
  const auto summary = program.summary();
  for (const char* key :
       {"program", "version", "input_file", "points", "steps", "wall_seconds", "points_steps_per_second",
        "peak_memory_bytes", "ranks", "threads", "energy_balance_error", "momentum_balance_error", "ended"})
    EXPECT_TRUE(summary.count(key)) << key;
  EXPECT_EQ(summary.at("program"), "\"penetrate\"");
  EXPECT_EQ(summary.at("threads"), "1");
  EXPECT_LT(std::stod(summary.at("energy_balance_error")), 1e-2);
  EXPECT_LT(std::stod(summary.at("momentum_balance_error")), 1e-3);
  EXPECT_GT(std::stod(summary.at("points_steps_per_second")), 1e4);

  const auto [names, rows] = program.history();
  for (const char* name :
       {"time", "projectile_position", "projectile_velocity", "contact_force", "kinetic_energy",
        "internal_energy", "friction_work", "contact_work", "total_energy", "momentum"})
    EXPECT_NE(std::find(names.begin(), names.end(), name), names.end()) << name;
  ASSERT_GE(rows.size(), 3u);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    ASSERT_EQ(rows[i].size(), names.size());
    for (const double value : rows[i]) EXPECT_TRUE(std::isfinite(value));
    if (i > 0) {
      EXPECT_GE(rows[i][0], rows[i - 1][0]);
    }
  }

  const Fields fields(program.output);
  const std::size_t points = std::stoul(summary.at("points")), frames = fields.list("/frames").size();
  EXPECT_GE(frames, 2u);
  const std::string body = summary.at("main_body"), group = body.substr(1, body.size() - 2);
  EXPECT_EQ(fields.read<float>("/frames/000/" + group + "/position", 3).size(), 3 * points);
  EXPECT_EQ(fields.read<float>("/frames/001/" + group + "/plastic_strain").size(), points);
  EXPECT_NEAR(fields.real_attribute("/frames/001", "time"), 0, 1);
  EXPECT_TRUE(std::filesystem::exists(program.output / "fields.xdmf"));
  EXPECT_EQ(program.text("stderr"), "");
}

TEST(Penetrate, WritesAllDocumentedFilesForATaylorBar) {
  Program program;
  ASSERT_EQ(program.run(tiny_taylor), 0) << program.text("stderr");
  expect_common_results(program);
  const auto summary = program.summary();
  EXPECT_NEAR(std::stod(summary.at("final_length_ratio")), 0.9, 0.1);
  EXPECT_GT(std::stod(summary.at("foot_diameter")), 7.6e-3);
  EXPECT_GT(std::stod(summary.at("max_plastic_strain")), 0.1);
}

TEST(Penetrate, WritesAllDocumentedFilesForASlabWithADamageTable) {
  Program program;
  write_damage_table(cracking_bar({0.03}), program.folder / "table.h5");
  ASSERT_EQ(program.run(with(tiny_slab, {"AFC/Damage table=" + (program.folder / "table.h5").string()})), 0)
      << program.text("stderr");
  expect_common_results(program);
  const auto summary = program.summary();
  for (const char* key :
       {"exit_velocity", "delta_v_percent", "delta_ke_percent", "absorbed_energy", "perforated",
        "time_of_exit", "front_crater_diameter", "back_crater_diameter", "damage_table"})
    EXPECT_TRUE(summary.count(key)) << key;
  EXPECT_EQ(summary.at("perforated"), "false");
  EXPECT_EQ(summary.at("time_of_exit"), "null");
  EXPECT_EQ(summary.at("exit_velocity"), "null"); // the projectile has not left the slab
  const double out = std::stod(summary.at("final_velocity"));
  EXPECT_LT(out, 313);
  EXPECT_NEAR(std::stod(summary.at("delta_v_percent")), 100 * (1 - out / 313), 1e-6);
  EXPECT_NEAR(std::stod(summary.at("absorbed_energy")), 0.5 * 2.34 * (313. * 313 - out * out), 1e-3);
}

TEST(Penetrate, BadInputIsOneLineAndNothingIsOverwritten) {
  Program program;
  write_damage_table(cracking_bar({0.03}), program.folder / "table.h5");
  const std::string whole = program.text("table.h5");
  program.folder.write("short.h5", whole.substr(0, whole.size() / 2));
  DamageTable foreign = cracking_bar({0.03});
  foreign.youngs_modulus *= 1.1;
  write_damage_table(foreign, program.folder / "foreign.h5");
  DamageTable pressed = cracking_bar({0.03});
  std::swap(pressed.curves[0].psi_undamaged_plus, pressed.curves[0].psi_undamaged_minus);
  write_damage_table(pressed, program.folder / "pressed.h5");
  const std::string old = "from an older run\n";
  for (const char* name : {"summary.json", "history.csv", "fields.h5", "fields.xdmf", "resolved.prm"})
    program.folder.write(std::string("out/") + name, old);

  const auto table = [&](const char* name) { return "AFC/Damage table=" + (program.folder / name).string(); };
  const struct {
    std::vector<std::string> words;
    std::vector<std::string> message;
  } cases[] = {
      {with(tiny_taylor, {"bar/Ringz=3"}), {"bar/Ringz=3", "did you mean 'bar/Rings'"}},
      {with(tiny_taylor, {"Time/End time=5 mm"}), {"End time", "5 mm", "us"}},
      {with(tiny_taylor, {"Time/End time=5"}), {"End time", "us"}},
      {with(tiny_taylor, {"bar/Rings=0"}), {"Rings", "at least 1"}},
      {with(tiny_taylor, {"Time/Newmark beta=0.25"}), {"Newmark beta", "0.25", "implicit"}},
      {with(tiny_taylor, {"Time/Newmark gamma=0.4"}), {"Newmark gamma", "0.4", "unstable"}},
      {with(tiny_taylor, {"wall/Model=deformable"}), {"'wall'"}},
      {with(tiny_taylor, {"Integration/Scheme=SCNI"}), {"Integration/Scheme", "SCNI", "Lagrangian"}},
      {with(tiny_taylor, {"Approximation/Basis order=0"}), {"Basis order", "NSNI", "1 or 2"}},
      {with(tiny_slab, {table("none.h5")}), {"none.h5", "does not exist"}},
      {with(tiny_slab, {table("short.h5")}), {"short.h5"}},
      {with(tiny_slab, {table("foreign.h5")}), {"Young"}},
      {with(tiny_slab, {table("pressed.h5")}), {"pressed.h5", "0 %", "more than 50 %"}},
      {{program.folder.write("bad.prm", "include " + taylor + "\nsubsection bar\n  set Ringz = 3\nend\n")},
       {"bad.prm:3", "Ringz"}},
      {{(program.folder / "none.prm").string()}, {"none.prm"}},
      {with(tiny_taylor, {"--ouput"}), {"--ouput"}},
  };
  for (const auto& [words, message] : cases) {
    EXPECT_EQ(program.run(with(words, {"--force"})), 2) << words.back();
    const std::string text = program.text("stderr");
    EXPECT_EQ(program.lines("stderr"), 1u) << text;
    EXPECT_EQ(text.substr(0, 11), "penetrate: ");
    for (const std::string& word : message)
      EXPECT_NE(text.find(word), std::string::npos) << word << " in: " << text;
    EXPECT_EQ(program.text("stdout"), "");
    for (const char* name : {"summary.json", "history.csv", "fields.h5", "fields.xdmf", "resolved.prm"})
      EXPECT_EQ(program.text(std::string("out/") + name), old) << words.back();
  }
}

TEST(Penetrate, AFailedComputationKeepsItsResults) {
  Program program;
  EXPECT_EQ(program.run(with(tiny_taylor, {"Run/Energy tolerance=1e-6"})), 3);
  const std::string text = program.text("stderr");
  EXPECT_EQ(program.lines("stderr"), 1u) << text;
  for (const char* word : {"t = ", "energy error", "Run/Energy tolerance"})
    EXPECT_NE(text.find(word), std::string::npos) << text;
  EXPECT_EQ(program.summary().at("ended").substr(0, 8), "\"failed:");
  EXPECT_GE(program.history().second.size(), 2u);
  EXPECT_GE(Fields(program.output).list("/frames").size(), 2u);
}

TEST(Penetrate, AnInterruptLeavesUsableResults) {
  Program program;
  program.start({taylor, "bar/Rings=8", "bar/Layers=50", "Output/History interval=0.01 us"});
  // The interrupt comes in the middle of the run, which would take many seconds.
  for (int n = 0; n < 1000; ++n) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    if (std::filesystem::exists(program.output / "history.csv") && program.lines("out/history.csv") > 10)
      break;
  }
  program.interrupt();
  EXPECT_EQ(program.wait(), 130);
  EXPECT_NE(program.text("stderr").find("interrupted at t = "), std::string::npos) << program.text("stderr");
  const auto summary = program.summary();
  EXPECT_EQ(summary.at("ended"), "\"interrupted\"");
  const double time = std::stod(summary.at("simulated_time"));
  EXPECT_GT(time, 0);
  EXPECT_LT(time, 20e-6);
  const auto [names, rows] = program.history();
  EXPECT_GT(rows.size(), 5u);
  EXPECT_NEAR(rows.back()[0], time, 1e-12);
  const Fields fields(program.output);
  const std::string last = fields.list("/frames").back();
  EXPECT_EQ(fields.real_attribute("/frames/" + last, "time"), time);
}

TEST(Penetrate, HelpNamesEveryKeyAndReturnsZero) {
  Program program;
  EXPECT_EQ(program.run({"--help"}), 0);
  for (const char* key :
       {"usage: penetrate", "Scene/Symmetry planes", "NAME/Rings", "NAME/AFC/Damage table",
        "NAME/J2/Yield stress", "NAME/Shape", "NAME/Velocity", "Answers/Exit", "Integration/Scheme",
        "Contact/Friction", "Time/End time", "Run/Threads", "allowed:", "default:"})
    EXPECT_NE(program.text("stdout").find(key), std::string::npos) << key;
  EXPECT_FALSE(std::filesystem::exists(program.output));
}

TEST(Penetrate, HelpOnASectionOrAKeyPrintsOnlyThatAndRefusesOthers) {
  Program program;
  for (const char* topic : {"AFC/C1", "NAME/AFC/C1", "slab/AFC/C1", "some body/afc/c1"}) {
    EXPECT_EQ(program.run({"--help", topic}), 0) << topic;
    EXPECT_EQ(program.text("stdout").find("\nNAME/AFC\n  NAME/AFC/C1\n"), 0U) << program.text("stdout");
    EXPECT_EQ(program.lines("stdout"), 5U) << program.text("stdout");
  }
  EXPECT_EQ(program.run({"--help", "AFC"}), 0);
  EXPECT_NE(program.text("stdout").find("NAME/AFC/Damage table"), std::string::npos);
  EXPECT_EQ(program.text("stdout").find("NAME/J2"), std::string::npos);
  EXPECT_EQ(program.run({"--help", "Height"}), 0);
  EXPECT_NE(program.text("stdout").find("must be set if Shape = cylinder or block; allowed"),
            std::string::npos);
  program.expect_refused({"--help", "AFCC"}, {"--help: found 'AFCC'", "did you mean 'AFC'"});
  program.expect_refused({"--help", "Tme/End time"}, {"did you mean 'Time/End time'"});
}

TEST(Penetrate, AKeyWithoutItsSectionIsToldTheBodiesThatHaveIt) {
  Program program;
  program.expect_refused(with(tiny_taylor, {"Rings=3"}),
                         {"expected Section/Key=value, found 'Rings=3'", "bar/Rings' or 'wall/Rings"});
}

TEST(Penetrate, NamesMayHoldTheSignOfAComment) {
  Program program;
  std::filesystem::create_directory(program.folder / "a #1");
  write_damage_table(cracking_bar({0.03}), program.folder / "a #1/t#.h5");
  const auto scene =
      program.folder.write("a #1/s#.prm", "include \"" + tiny_slab.front() +
                                              "\" # a slab\n"
                                              "set slab/AFC/Damage table = t#.h5 # beside it\n");
  std::vector<std::string> words = with(tiny_slab, {"Time/End time=10 us"});
  words.front() = scene;
  ASSERT_EQ(program.run(words), 0) << program.text("stderr");
  const std::string input = program.text("out/resolved.prm");
  EXPECT_NE(input.find("a #1/t#.h5\"\n"), std::string::npos) << input;
  ASSERT_EQ(
      program.run_without_output({(program.output / "resolved.prm").string(), "-o", program.folder / "b"}), 0)
      << program.text("stderr");
  EXPECT_EQ(program.text("b/resolved.prm"), input);
}

TEST(Penetrate, ASceneThatUndoesItsOwnChangeIsWarnedOf) {
  Program program;
  const auto scene = program.folder.write(
      "s.prm", "include " + taylor + "\nset bar/Rings = 3\ninclude more.prm\nset bar/Layers = 12\n");
  program.folder.write("more.prm", "set bar/Rings = 4\n");
  EXPECT_EQ(program.run({scene.string(), "--plan"}), 0);
  EXPECT_EQ(program.lines("stderr"), 1U);
  EXPECT_NE(program.text("stderr").find("penetrate: warning: " + scene.string() + ":3: include 'more.prm'"),
            std::string::npos)
      << program.text("stderr");
}

} // namespace
} // namespace spall::test
