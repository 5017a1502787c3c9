// Tests of the program microcell as a process: its command line, files and exit codes.

#include "shared/damage_table.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>

namespace {

namespace fs = std::filesystem;
using namespace spall;

struct Microcell : testing::Test {
  const fs::path folder = fs::temp_directory_path() / ("spall_microcell_" + std::to_string(getpid()));
  const std::string data = MICROCELL_DATA;
  void SetUp() override { fs::create_directories(folder); }
  void TearDown() override { fs::remove_all(folder); }

  int run(const std::string& arguments, int ranks = 1) const {
    const std::string launcher = ranks == 1
                                     ? ""
                                     : "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 mpirun "
                                       "--oversubscribe -n " +
                                           std::to_string(ranks) + " ";
    const std::string command = launcher + MICROCELL + " " + arguments + " --output '" +
                                (folder / "out").string() + "' > '" + (folder / "stdout").string() +
                                "' 2> '" + (folder / "stderr").string() + "'";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  std::string text(const std::string& name) const {
    std::ifstream stream(folder / name);
    std::ostringstream content;
    content << stream.rdbuf();
    return content.str();
  }
  static int count(const std::string& where, const std::string& what) {
    int found = 0;
    for (auto at = where.find(what); at != std::string::npos; at = where.find(what, at + 1)) ++found;
    return found;
  }
};

// The table of a cell with aggregates has the constants that the macroscopic model requires.
TEST_F(Microcell, AggregatesKeepTheMaterialsConstants) {
  const std::string small = data + "/aggregates.prm 'Cell/Sizes=15 mm' 'Cell/Reference size=15 mm' "
                                   "'Aggregates/Smallest diameter=4 mm' 'Output/Field states=2'";
  ASSERT_EQ(run(small), 0) << text("stderr");
  const DamageTable table = read_damage_table(folder / "out/damage_table.h5");
  EXPECT_NEAR(table.youngs_modulus, 18727.28e6, 1e-6 * 18727.28e6);
  EXPECT_NEAR(table.poisson_ratio, 0.3584868, 1e-6);
  EXPECT_NE(table.crack_set.find("seed 1"), std::string::npos);
  EXPECT_NE(text("out/fields_001.vtu").find("material"), std::string::npos);
  for (const char* key : {"anisotropy", "crack_length_interface_zone", "crack_length_mortar"})
    EXPECT_NE(text("out/summary.json").find(key), std::string::npos) << key;
  // As given, the stiffer aggregates show.
  ASSERT_EQ(run(small + " 'Aggregates/Scale to the material=no' --force"), 0) << text("stderr");
  const double stiffness = read_damage_table(folder / "out/damage_table.h5").youngs_modulus;
  EXPECT_GT(stiffness, 1.1 * 25e9);
  EXPECT_LT(stiffness, 0.6 * 25e9 + 0.4 * 70e9);
}

TEST_F(Microcell, WritesAllDocumentedFiles) {
  ASSERT_EQ(run(data + "/wes5000.prm"), 0) << text("stderr");
  const DamageTable table = read_damage_table(folder / "out/damage_table.h5");
  ASSERT_EQ(table.curves.size(), 5U);
  EXPECT_DOUBLE_EQ(table.curves[2].cell_size, 0.015875);
  for (const DamageCurve& curve : table.curves) EXPECT_NEAR(curve.damage.back(), 1, 1e-9);
  // The elastic constants of the concrete law are K = C6 / C7 and G of the paper's Table 1.
  const double K = 55.14e6 / 0.0025, G = 6892.7e6;
  EXPECT_NO_THROW(check_elastic_constants(table, 9 * K * G / (3 * K + G), (3 * K - 2 * G) / (2 * (3 * K + G)),
                                          "AFC", 1e-5));
  EXPECT_EQ(table.boundary, "periodic");
  EXPECT_NE(table.provenance.input.find("Fracture energy"), std::string::npos);

  EXPECT_GT(fs::file_size(folder / "out/damage_table.csv"), 0U);
  const std::string curve = text("out/curve.csv");
  EXPECT_EQ(curve.rfind("strain,stress,psi_bulk,", 0), 0U);
  EXPECT_EQ(static_cast<std::size_t>(count(curve, "\n")), table.curves[2].strain.size() + 1);
  const std::string series = text("out/fields.pvd");
  EXPECT_EQ(count(series, ".vtu"), 8);
  const std::string last = text("out/fields_007.vtu");
  for (const char* name : {"displacement", "stress_xx", "stress_yy", "stress_zz", "stress_xy"})
    EXPECT_NE(last.find(name), std::string::npos) << name;
  EXPECT_NE(text("stdout").find("against stress x strain / 2"), std::string::npos);
  EXPECT_NE(text("stdout").find("against work minus dissipation"), std::string::npos);
  const std::string summary = text("out/summary.json");
  for (const char* key : {"program",
                          "version",
                          "input_file",
                          "dofs",
                          "condensed_unknowns",
                          "steps",
                          "wall_seconds",
                          "seconds_per_load_step",
                          "peak_memory_bytes",
                          "ranks",
                          "threads",
                          "energy_balance_error",
                          "initial_damage",
                          "peak_stress",
                          "strain_at_peak",
                          "work",
                          "work_to_failure_expected",
                          "psi_against_stress_error",
                          "energy_balance_tolerance",
                          "psi_against_stress_tolerance",
                          "energy_checks_passed"})
    EXPECT_NE(summary.find("\"" + std::string(key) + "\": "), std::string::npos) << key;
}

TEST_F(Microcell, BadInputIsOneLineAndOverwritesNothing) {
  ASSERT_EQ(run(data + "/case_a.prm 'Output/Field states=0'"), 0) << text("stderr");
  const auto written = fs::last_write_time(folder / "out/damage_table.h5");
  for (const char* bad :
       {"'Material/Tensile strength=-3 MPa'", "'Material/Tensile strength=3'", "'Cell/Initial crack=1'",
        "'Cell/Sizes=20 mm'", "'Cell/Nonsense=1'", "'Mesh/Degree=7'", "--nonsense", "second.prm",
        "'Cell/Sizes=500 mm' 'Cell/Reference size=500 mm'"}) {
    EXPECT_EQ(run(data + "/case_a.prm --force " + bad), 2) << bad;
    EXPECT_EQ(count(text("stderr"), "\n"), 1) << text("stderr");
    EXPECT_EQ(fs::last_write_time(folder / "out/damage_table.h5"), written) << bad;
  }
  EXPECT_EQ(run("no_such_file.prm"), 2);
  EXPECT_EQ(run(""), 2);
}

TEST_F(Microcell, SnapBackEndsWithCodeThreeKeepingTheCurveAndNoTableOfAnotherCell) {
  ASSERT_EQ(run(data + "/case_a.prm 'Output/Field states=0'"), 0) << text("stderr");
  ASSERT_TRUE(fs::exists(folder / "out/damage_table.h5"));
  ASSERT_EQ(run(data + "/case_a.prm 'Cell/Sizes=1600 mm' 'Cell/Reference size=1600 mm' Mesh/Degree=1 "
                       "Mesh/Grading=1 Mesh/Elements=40 'Output/Field states=2' Loading/Snap-back=refuse "
                       "--force"),
            3);
  EXPECT_NE(text("stderr").find("at strain"), std::string::npos) << text("stderr");
  EXPECT_FALSE(fs::exists(folder / "out/damage_table.h5"));
  const std::string curve = text("out/curve.csv");
  EXPECT_GT(count(curve, "\n"), 20);
  EXPECT_EQ(count(curve, "# incomplete: "), 1);
  EXPECT_NE(text("out/summary.json").find("\"complete\": false"), std::string::npos);
}

// The bulk of a large cell releases more energy than its crack can dissipate, so the strain must decrease
// while the crack grows.
TEST_F(Microcell, PassesSnapBackWithTheFractureEnergyAndWritesTheEnvelope) {
  ASSERT_EQ(run(data + "/case_a.prm 'Cell/Sizes=1600 mm' 'Cell/Reference size=1600 mm' Mesh/Degree=1 "
                       "Mesh/Grading=1 Mesh/Elements=40 'Output/Field states=0'"),
            0)
      << text("stderr");
  EXPECT_NE(text("stdout").find("snap-back"), std::string::npos);
  std::istringstream rows(text("out/curve.csv"));
  std::string row, last;
  std::getline(rows, row);
  double strain = 0, before = 0, fell = 0, work = 0;
  while (std::getline(rows, row)) {
    before = strain;
    strain = std::stod(row);
    fell = std::max(fell, before - strain);
    last = row;
  }
  EXPECT_GT(fell, 0);
  std::istringstream columns(last);
  for (int i = 0; i < 13; ++i) std::getline(columns, row, ',');
  work = std::stod(row);
  const double expected = 80 * 0.75 / 1.6; // G_f (1 - 2 a0 / l) / l
  EXPECT_NEAR(work, expected, 0.002 * expected);
  const DamageTable table = read_damage_table(folder / "out/damage_table.h5"); // strictly increasing strain
  EXPECT_NEAR(table.curves[0].damage.back(), 1, 1e-9);
}

TEST_F(Microcell, TheFieldsOfASnapBackFollowTheLoadingAndKnowTheirStrain) {
  ASSERT_EQ(run(data + "/case_a.prm 'Cell/Sizes=1600 mm' 'Cell/Reference size=1600 mm' Mesh/Degree=1 "
                       "Mesh/Grading=1 Mesh/Elements=40 'Output/Field states=12'"),
            0)
      << text("stderr");
  std::vector<double> strains; // of the rows of the curve
  std::istringstream rows(text("out/curve.csv"));
  std::string row;
  std::getline(rows, row);
  while (std::getline(rows, row)) strains.push_back(std::stod(row));
  const std::string series = text("out/fields.pvd");
  const std::regex entry("timestep=\"([^\"]+)\".*file=\"([^\"]+)\""),
      number("macroscopic_strain\"[^>]*>([^<]+)<");
  double time = -1, strain = 0, fell = 0;
  for (std::sregex_iterator m(series.begin(), series.end(), entry), end; m != end; ++m) {
    EXPECT_GT(std::stod((*m)[1]), time);
    time = std::stod((*m)[1]);
    const std::string cell = text("out/" + std::string((*m)[2]));
    std::smatch found;
    ASSERT_TRUE(std::regex_search(cell, found, number));
    const double before = strain;
    strain = std::stod(found[1]);
    EXPECT_NEAR(strain, strains.at(static_cast<std::size_t>(time)), 1e-6 * std::abs(strain));
    fell = std::max(fell, before - strain);
  }
  EXPECT_EQ(time + 1, strains.size());
  EXPECT_GT(fell, 0);
}

TEST_F(Microcell, LinearDisplacementBoundaryWarnsThatNoCrackCrosses) {
  ASSERT_EQ(run(data + "/case_a.prm 'Cell/Boundary=linear displacement' 'Output/Field states=0'"), 0);
  EXPECT_NE(text("stdout").find("no crack can cross"), std::string::npos);
  EXPECT_NE(text("out/summary.json").find("\"caution\": "), std::string::npos);
  EXPECT_NEAR(read_damage_table(folder / "out/damage_table.h5").curves[0].damage.back(), 0.79, 0.01);
}

TEST_F(Microcell, AnInterruptedEnsembleEndsLikeAnUndisturbedOne) {
  const std::string ensemble = data + "/ensemble.prm Ensemble/Samples=5 Mesh/Degree=1 ";
  ASSERT_EQ(run(ensemble + "Ensemble/Threads=2"), 0) << text("stderr");
  const DamageTable whole = read_damage_table(folder / "out/damage_table.h5"),
                    weak = read_damage_table(folder / "out/damage_table_weak.h5");
  // An interruption leaves some of the samples. One of them has another input and must not be reused.
  fs::remove(folder / "out/samples/sample_000001.h5");
  fs::remove(folder / "out/samples/sample_000004.h5");
  ASSERT_EQ(run(ensemble + "Ensemble/Threads=1 Ensemble/Samples=3 Ensemble/Seed=7 --force"), 0);
  fs::copy_file(folder / "out/samples/sample_000002.h5", folder / "foreign.h5");
  ASSERT_EQ(run(ensemble + "Ensemble/Threads=1 --force"), 0);
  fs::remove(folder / "out/samples/sample_000004.h5");
  fs::rename(folder / "foreign.h5", folder / "out/samples/sample_000002.h5");
  ASSERT_EQ(run(ensemble + "Ensemble/Threads=1 --restart"), 0) << text("stderr");
  EXPECT_NE(text("stdout").find("2 computed, 3 reused"), std::string::npos) << text("stdout");
  const DamageTable again = read_damage_table(folder / "out/damage_table.h5"),
                    weak_again = read_damage_table(folder / "out/damage_table_weak.h5");
  ASSERT_EQ(whole.curves.size(), again.curves.size());
  for (std::size_t i = 0; i < whole.curves.size(); ++i)
    for (const DamageColumn& column : damage_columns) {
      EXPECT_EQ(whole.curves[i].*column.values, again.curves[i].*column.values) << column.name;
      EXPECT_EQ(weak.curves[i].*column.values, weak_again.curves[i].*column.values) << column.name;
    }
}

/// Contents and times of all files of the results.
std::map<std::string, std::pair<std::uintmax_t, fs::file_time_type>> results(const fs::path& folder) {
  std::map<std::string, std::pair<std::uintmax_t, fs::file_time_type>> all;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) all[entry.path().string()] = {entry.file_size(), entry.last_write_time()};
  return all;
}

TEST_F(Microcell, ResultsAreNotReplacedUnaskedAndAFinishedCaseSaysSo) {
  const std::string cell = data + "/case_a.prm 'Output/Field states=2' ",
                    ensemble = data + "/ensemble.prm Ensemble/Samples=3 Mesh/Degree=1 ";
  EXPECT_EQ(run(cell + "--restart"), 2); // nothing to go on from
  EXPECT_FALSE(fs::exists(folder / "out"));
  for (const std::string& words : {cell, ensemble}) {
    fs::remove_all(folder / "out");
    ASSERT_EQ(run(words), 0) << text("stderr");
    const auto before = results(folder / "out");
    for (const char* more :
         {"", "'Material/Tensile strength=2 MPa'", "--restart 'Material/Tensile strength=2 MPa'"}) {
      EXPECT_EQ(run(words + more), 2) << more;
      EXPECT_EQ(count(text("stderr"), "\n"), 1) << text("stderr");
      EXPECT_TRUE(results(folder / "out") == before) << more;
    }
    EXPECT_EQ(run(words + "--restart"), 0);
    EXPECT_EQ(count(text("stdout"), "is finished"), 1) << text("stdout");
    EXPECT_TRUE(results(folder / "out") == before);
    EXPECT_EQ(run(words + "--force"), 0) << text("stderr");
    EXPECT_FALSE(results(folder / "out") == before);
  }
  // More samples extend an ensemble.
  ASSERT_EQ(run(data + "/ensemble.prm Ensemble/Samples=4 Mesh/Degree=1 --restart"), 0) << text("stderr");
  EXPECT_EQ(count(text("stdout"), "1 computed, 3 reused"), 1) << text("stdout");
}

TEST_F(Microcell, TheResolvedInputRepeatsTheCaseBitForBitFromAnyFolder) {
  ASSERT_EQ(run(data + "/penny.prm 'Output/Field states=0' Mesh/Elements=2"), 0) << text("stderr");
  const std::string curve = text("out/curve.csv");
  fs::create_directories(folder / "far");
  fs::rename(folder / "out/resolved.prm", folder / "far/again.prm");
  fs::remove_all(folder / "out");
  const fs::path here = fs::current_path();
  fs::current_path(folder / "far");
  EXPECT_EQ(run("again.prm"), 0) << text("stderr");
  fs::current_path(here);
  EXPECT_EQ(text("out/curve.csv"), curve);
  EXPECT_GT(count(curve, "\n"), 10);
}

TEST_F(Microcell, EveryWriteIsChecked) {
  // Standard output.
  const std::string full = "MICROCELL='" MICROCELL "'; \"$MICROCELL\" ";
  const auto shell = [&](const std::string& command) {
    const int status = std::system(("(" + command + ") 2> '" + (folder / "stderr").string() + "'").c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  };
  const std::string cell =
      data + "/case_a.prm 'Output/Field states=0' --force --output '" + (folder / "out").string() + "'";
  EXPECT_EQ(shell(full + "--help > /dev/full"), 3);
  EXPECT_EQ(count(text("stderr"), "standard output could not be written"), 1) << text("stderr");
  EXPECT_EQ(shell(full + cell + " > /dev/full"), 3);
  EXPECT_NO_THROW(read_damage_table(folder / "out/damage_table.h5"));
  EXPECT_EQ(shell(full + cell + " >&-"), 0);
  EXPECT_NO_THROW(read_damage_table(folder / "out/damage_table.h5"));
  // The disk: there is no half table, and the summary says what has happened.
  EXPECT_EQ(shell("ulimit -f " + std::to_string(fs::file_size(folder / "out/curve.csv") / 512 + 20) + "; " +
                  full + cell + " > /dev/null"),
            3)
      << text("stderr");
  EXPECT_EQ(count(text("stderr"), "damage_table.h5"), 1) << text("stderr");
  EXPECT_FALSE(fs::exists(folder / "out/damage_table.h5"));
  EXPECT_NE(text("out/summary.json").find("\"complete\": false"), std::string::npos);
}

TEST_F(Microcell, AnEnsembleOnSeveralRanksIsThatOfOneToTheLastBit) {
  const std::string ensemble = data + "/ensemble.prm Ensemble/Samples=5 Mesh/Degree=1 ";
  const auto tables = [&] {
    std::vector<DamageTable> all;
    for (const char* name : {"damage_table.h5", "damage_table_weak.h5", "damage_table_strong.h5"})
      all.push_back(read_damage_table(folder / "out" / name));
    return all;
  };
  ASSERT_EQ(run(ensemble + "Ensemble/Threads=2"), 0) << text("stderr");
  const std::vector<DamageTable> alone = tables();
  EXPECT_LT(alone[1].curves[0].relative_strength, 0.97);
  EXPECT_EQ(alone[0].curves[0].relative_strength, 1);
  EXPECT_GT(alone[2].curves[0].relative_strength, 1.03);
  for (const int ranks : {2, 4}) {
    fs::remove_all(folder / "out");
    ASSERT_EQ(run(ensemble, ranks), 0) << text("stderr");
    EXPECT_EQ(count(text("stdout"), "5 computed, 0 reused"), 1) << text("stdout");
    EXPECT_NE(text("out/summary.json").find("\"ranks\": " + std::to_string(ranks)), std::string::npos);
    const std::vector<DamageTable> together = tables();
    for (std::size_t t = 0; t < 3; ++t)
      for (std::size_t i = 0; i < alone[t].curves.size(); ++i) {
        EXPECT_EQ(alone[t].curves[i].relative_strength, together[t].curves[i].relative_strength);
        for (const DamageColumn& column : damage_columns)
          EXPECT_EQ(alone[t].curves[i].*column.values, together[t].curves[i].*column.values) << column.name;
      }
  }
  // Samples that one rank has written are reused by others.
  fs::remove(folder / "out/samples/sample_000003.h5");
  ASSERT_EQ(run(ensemble + "--restart", 2), 0) << text("stderr");
  EXPECT_EQ(count(text("stdout"), "1 computed, 4 reused"), 1) << text("stdout");
}

TEST_F(Microcell, FailuresOfAllRanksAreGathered) {
  EXPECT_EQ(run(data + "/ensemble.prm Ensemble/Samples=5 Mesh/Degree=1 Solver/Iterations=1 "
                       "Loading/Snap-back=refuse 'Loading/Row growth=0.2' 'Loading/Smallest step=1'",
                2),
            3);
  EXPECT_EQ(count(text("stderr"), "5 of 5 samples failed, first seed 1: "), 1) << text("stderr");
  EXPECT_EQ(count(text("stdout"), "failed: seed "), 5);
  EXPECT_NE(text("out/summary.json").find("\"samples_failed\": 5"), std::string::npos);
}

TEST_F(Microcell, ASingleCellIsComputedByOneOfSeveralRanks) {
  ASSERT_EQ(run(data + "/case_a.prm 'Output/Field states=2'", 2), 0) << text("stderr");
  EXPECT_EQ(count(text("stdout"), "results in"), 1);
  EXPECT_EQ(count(text("stdout"), "by the first of the 2 ranks alone"), 1);
  EXPECT_NEAR(read_damage_table(folder / "out/damage_table.h5").curves[0].damage.back(), 1, 1e-9);
  EXPECT_EQ(run(data + "/case_a.prm Cell/Nonsense=1", 2), 2);
  EXPECT_EQ(count(text("stderr"), "unknown key"), 1) << "the error must be printed by one rank only";
}

TEST_F(Microcell, HelpOnASectionOrAKeyPrintsOnlyThatAndRefusesOthers) {
  ASSERT_EQ(run("--help Solver"), 0);
  EXPECT_EQ(text("stdout").find("\nSolver\n  Solver/Tolerance\n"), 0U) << text("stdout");
  EXPECT_EQ(count(text("stdout"), "Mesh/"), 0);
  ASSERT_EQ(run("--help aggregates/refinements"), 0);
  EXPECT_EQ(count(text("stdout"), "allowed:"), 1);
  EXPECT_EQ(run("--help Solvers"), 2);
  EXPECT_EQ(count(text("stderr"), "did you mean 'Solver'"), 1) << text("stderr");
}

TEST_F(Microcell, HelpListsEveryKey) {
  ASSERT_EQ(run("--help"), 0);
  for (const char* key : {"Material/Fracture energy", "Cell/Sizes", "Mesh/Elements", "Loading/Row growth",
                          "Solver/Tolerance", "Output/Field states"})
    EXPECT_NE(text("stdout").find(key), std::string::npos) << key;
}

} // namespace
