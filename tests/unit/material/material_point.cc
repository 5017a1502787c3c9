#include "tests/unit/material/cracking_cell.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <sys/wait.h>
#include <unistd.h>

namespace spall::test {
namespace {

namespace fs = std::filesystem;

const std::string header = "time,exx,eyy,ezz,exy,eyz,exz\n";

/// Runs the program in a folder of its own, as a user would.
class MaterialPoint : public ::testing::Test {
protected:
  MaterialPoint() {
    folder = fs::temp_directory_path() / ("spall_material_point_" + std::to_string(getpid()) + "_" +
                                          ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder);
    write("path.csv", header + "0,0,0,0,0,0,0\n1e-3,1e-4,0,0,0,0,0\n2e-3,2e-4,0,0,0,0,0\n");
    write("metal.prm", "include " SPALL_DATA "/materials/steel_4340.prm\n");
    write("concrete.prm", "include " SPALL_DATA "/materials/wes5000.prm\n");
  }
  ~MaterialPoint() override { fs::remove_all(folder); }

  void write(const std::string& name, const std::string& text) { std::ofstream(folder / name) << text; }
  std::string read(const std::string& name) {
    std::ostringstream text;
    text << std::ifstream(folder / name).rdbuf();
    return text.str();
  }
  int run(const std::string& arguments) {
    const std::string command =
        "cd '" + folder.string() + "' && '" MATERIAL_POINT "' >stdout 2>stderr " + arguments;
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  /// Expects a refusal: exit code 2, a message of one line that contains `words`, and an unchanged earlier
  /// result.
  void expect_refused(const std::string& arguments, const std::string& words) {
    write("result.csv", "earlier result");
    EXPECT_EQ(run(arguments + " --output result.csv"), 2) << arguments;
    const std::string message = read("stderr");
    EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 1) << message;
    EXPECT_NE(message.find(words), std::string::npos) << message;
    EXPECT_EQ(read("result.csv"), "earlier result");
  }
  /// The rows of an output file by column.
  std::vector<std::map<std::string, double>> table(const std::string& name) {
    std::istringstream stream(read(name));
    std::string line, cell;
    std::vector<std::string> names;
    std::getline(stream, line);
    for (std::istringstream cells(line); std::getline(cells, cell, ',');) names.push_back(cell);
    std::vector<std::map<std::string, double>> rows;
    while (std::getline(stream, line)) {
      std::istringstream cells(line);
      rows.emplace_back();
      for (const std::string& column : names)
        if (std::getline(cells, cell, ',')) rows.back()[column] = std::stod(cell);
    }
    return rows;
  }
  fs::path folder;
};

TEST_F(MaterialPoint, WritesStressHistoryAndEnergyOfAnElasticPull) {
  ASSERT_EQ(run("metal.prm path.csv --output result.csv"), 0) << read("stderr");
  const auto rows = table("result.csv");
  ASSERT_EQ(rows.size(), 3u);
  const double E = 205e9, nu = 0.26, M = E * (1 - nu) / ((1 + nu) * (1 - 2 * nu));
  EXPECT_EQ(rows[0].at("sxx"), 0);
  EXPECT_NEAR(rows[2].at("sxx"), M * 2e-4, 1);
  EXPECT_NEAR(rows[2].at("syy"), M * 2e-4 * nu / (1 - nu), 1);
  EXPECT_NEAR(rows[2].at("pressure"), -E / (3 * (1 - 2 * nu)) * 2e-4, 1);
  EXPECT_NEAR(rows[2].at("energy"), M * 2e-4 * 2e-4 / 2, 1e-3);
  EXPECT_EQ(rows[2].at("plastic_strain"), 0);
  EXPECT_EQ(rows[2].at("exx"), 2e-4);
  EXPECT_EQ(rows[2].at("time"), 2e-3);

  // The inputs kept beside the result repeat the run.
  ASSERT_EQ(run("result.csv.prm path.csv --output again.csv"), 0) << read("stderr");
  EXPECT_EQ(read("again.csv"), read("result.csv"));
}

TEST_F(MaterialPoint, FollowsTheHydrostatOfConcrete) {
  write("path.csv",
        header + "0,0,0,0,0,0,0\n1,-0.03333333333333333,-0.03333333333333333,-0.03333333333333333,0,0,0\n");
  ASSERT_EQ(run("concrete.prm path.csv --output result.csv Path/Substeps=10"), 0) << read("stderr");
  const auto rows = table("result.csv");
  EXPECT_NEAR(rows.at(1).at("pressure") / MPa, 591.5, 0.05);
  EXPECT_NEAR(rows.at(1).at("largest_compression"), 0.1, 1e-12);
}

TEST_F(MaterialPoint, FreeSidesGiveYoungsModulus) {
  ASSERT_EQ(run("metal.prm path.csv 'Path/Lateral=stress free'"), 0) << read("stderr");
  const auto rows = table("stdout"); // without --output
  EXPECT_NEAR(rows.at(2).at("sxx"), 205e9 * 2e-4, 100);
  EXPECT_NEAR(rows.at(2).at("eyy"), -0.26 * 2e-4, 1e-9);
  EXPECT_NEAR(rows.at(2).at("szz"), 0, 100);
}

TEST_F(MaterialPoint, MetalYieldsAtItsYieldStress) {
  write("path.csv", header + "0,0,0,0,0,0,0\n1,0.05,0,0,0,0,0\n2,0.03,0,0,0,0,0\n");
  ASSERT_EQ(run(SPALL_DATA "/materials/aluminium_6061_t6.prm path.csv 'Path/Lateral=stress free' "
                           "Path/Substeps=100"),
            0)
      << read("stderr");
  const auto rows = table("stdout");
  const J2 metal = test::metal("aluminium_6061_t6");
  EXPECT_NEAR(rows.at(1).at("sxx") / metal.yield_stress({rows.at(1).at("plastic_strain")}), 1, 1e-6);
  EXPECT_NEAR(rows.at(1).at("plastic_strain"), 0.05 - rows.at(1).at("sxx") / metal.youngs_modulus, 1e-6);
  EXPECT_NEAR(rows.at(2).at("sxx") / metal.initial_yield, -1, 1e-6); // the other way after unloading
}

// Any row is divided until its stress and its work are right, so that what comes out does not depend on how
// many rows a path has.
TEST_F(MaterialPoint, TheWorkOfOneRowIsThatOfManySteps) {
  write("path.csv", header + "0,0,0,0,0,0,0\n1,0,0,0,0.02,0,0\n");
  for (const char* name : {"steel_4340", "aluminium_6061_t6", "copper"}) {
    ASSERT_EQ(run(std::string(SPALL_DATA "/materials/") + name + ".prm path.csv"), 0) << read("stderr");
    // Shear by e: equivalent stress sqrt(3) s, equivalent strain 2 e / sqrt(3), linear hardening.
    const J2 metal = test::metal(name);
    const double G = metal.shear_modulus(), H = metal.hardening_modulus, y = metal.initial_yield;
    const double total = 2 * 0.02 / std::sqrt(3.), plastic = (3 * G * total - y) / (3 * G + H);
    const double last = y + H * plastic,
                 work = y * plastic + H * plastic * plastic / 2 + last * last / (6 * G);
    const auto rows = table("stdout");
    EXPECT_NEAR(rows.at(1).at("energy"), work, 1e-3 * work) << name;
    EXPECT_NEAR(rows.at(1).at("sxy"), last / std::sqrt(3.), 1e-3 * last) << name;
  }
}

TEST_F(MaterialPoint, OneRowIsAsGoodAsManyWhereConcreteCracks) {
  write_damage_table(cracking_cell(concrete("wes5000"), 16e-3, 2.47 * MPa, 80), folder / "table.h5");
  std::string fine = header + "0,0,0,0,0,0,0\n";
  for (int i = 1; i <= 2000; ++i)
    fine += std::to_string(i / 2000.) + "," + std::to_string(i) + "e-6,0,0,0,0,0\n";
  write("fine.csv", fine);
  write("path.csv", header + "0,0,0,0,0,0,0\n1,2e-3,0,0,0,0,0\n");
  for (const std::string lateral : {"strain", "stress free"}) {
    const std::string inputs =
        " 'AFC/Damage table=table.h5' 'Path/Spacing=16 mm' 'Path/Lateral=" + lateral + "'";
    ASSERT_EQ(run("concrete.prm fine.csv Path/Substeps=20 Path/Tolerance=0" + inputs), 0) << read("stderr");
    const auto many = table("stdout").back();
    ASSERT_EQ(run("concrete.prm path.csv" + inputs), 0) << read("stderr");
    const auto one = table("stdout").back();
    EXPECT_NEAR(one.at("energy"), many.at("energy"), 2e-3 * many.at("energy")) << lateral;
    EXPECT_NEAR(one.at("sxx"), many.at("sxx"), 2e-3 * 6 * MPa) << lateral; // of the largest stress
  }
}

TEST_F(MaterialPoint, SaysWhereItMissesTheTolerance) {
  write("path.csv", header + "0,0,0,0,0,0,0\n1,1e-3,0,0,0,0,0\n2,2e-2,0,0,0.02,0,0\n");
  EXPECT_EQ(run("metal.prm path.csv --output result.csv Path/Tolerance=1e-15"), 3);
  EXPECT_NE(read("stderr").find("Path/Tolerance"), std::string::npos) << read("stderr");
  // Without a tolerance: exactly the steps that are asked for.
  ASSERT_EQ(run("metal.prm path.csv --output fixed.csv Path/Tolerance=0"), 0) << read("stderr");
  EXPECT_EQ(table("fixed.csv").size(), 3u);
}

// The two sides of an ensemble of microcells, by their tables alone.
TEST_F(MaterialPoint, WeakAndStrongTablesBracketTheMean) {
  const Afc afc = concrete("wes5000");
  write("path.csv", header + "0,0,0,0,0,0,0\n1,1.5e-4,0,0,0,0,0\n");
  double last = 0;
  for (const double strength : {0.85, 1.0, 1.15}) {
    DamageTable made = cracking_cell(afc, 16e-3, 2.47 * MPa, 80);
    made.curves[0].relative_strength = strength;
    write_damage_table(made, folder / "table.h5");
    ASSERT_EQ(run("concrete.prm path.csv 'AFC/Damage table=table.h5' 'Path/Spacing=16 mm' Path/Substeps=100"),
              0)
        << read("stderr");
    const double stress = table("stdout").at(1).at("sxx");
    EXPECT_GT(stress, last + 0.2 * MPa);
    last = stress;
  }
}

TEST_F(MaterialPoint, PathsOfTheDataFolderRun) {
  for (const char* name : {"uniaxial_tension", "uniaxial_compression", "hydrostatic",
                           "triaxial_compression_slow", "triaxial_compression_fast"})
    EXPECT_EQ(run(std::string("concrete.prm " SPALL_DATA "/experiments/") + name + ".csv"), 0)
        << name << ": " << read("stderr");
}

TEST_F(MaterialPoint, EveryMaterialOfThePaperRuns) {
  for (const char* name :
       {"wes5000", "wes5000_u", "wes5000_g3", "aluminium_6061_t6", "steel_1090", "steel_4340", "copper"})
    EXPECT_EQ(run(std::string(SPALL_DATA "/materials/") + name + ".prm path.csv"), 0) << read("stderr");
}

TEST_F(MaterialPoint, RefusesBadMaterialFiles) {
  write("bad.prm", "include concrete.prm\nsubsection AFC\n set Shear modulos = 1 MPa\nend\n");
  expect_refused("bad.prm path.csv",
                 "bad.prm:3: unknown key 'Shear modulos' (did you mean 'AFC/Shear modulus'?)");
  write("bad.prm", "include concrete.prm\nsubsection AFC\n set C1 = 501 mm\nend\n");
  expect_refused("bad.prm path.csv", "bad.prm:3: key 'C1': found '501 mm', allowed: a number with its unit");
  write("bad.prm", "include concrete.prm\nsubsection Concrete\n set C1 = 501 MPa\nend\n");
  expect_refused("bad.prm path.csv", "bad.prm:2: unknown subsection 'Concrete'");
  write("bad.prm", "subsection Material\n set Law = AFC\nend\n");
  expect_refused("bad.prm path.csv", "key 'AFC/Density' must be set");
  write("bad.prm", "include concrete.prm\nsubsection Material\n set Law = J2\nend\n");
  expect_refused("bad.prm path.csv", "key 'J2/Young's modulus' must be set");
  expect_refused("concrete.prm path.csv AFC/C9=0.001", "key 'AFC/C9': found '0.001', allowed: > C7");
  expect_refused("nowhere.prm path.csv", "nowhere.prm: does not exist");
  expect_refused("concrete.prm", "expected MATERIAL.prm and PATH.csv");
}

TEST_F(MaterialPoint, RefusesBadPaths) {
  const auto refuse = [&](const std::string& text, const std::string& words) {
    write("bad.csv", text);
    expect_refused("metal.prm bad.csv", words);
  };
  refuse("time,exx,eyy,ezz,exy,eyz\n0,0,0,0,0,0\n", "bad.csv:1: column 'exz' is missing");
  refuse("time,exx,eyy,ezz,exy,eyz,exz,e\n", "bad.csv:1: found column 'e'");
  refuse(header + "0,0,0,0,0,0,0\n1,0,x,0,0,0,0\n", "bad.csv:3: column 'eyy': found 'x', allowed: a number");
  refuse(header + "0,0,0,0,0,0,0\n1,0,nan,0,0,0,0\n", "bad.csv:3: column 'eyy': found 'nan'");
  refuse(header + "0,0,0,0,0,0,0\n1,0,0\n", "bad.csv:3: found 3 values, allowed: 7");
  refuse(header + "0,0,0,0,0,0,0\n2,1e-3,0,0,0,0,0\n1,2e-3,0,0,0,0,0\n",
         "bad.csv:4: column 'time': found '1'");
  refuse(header + "0,1e-3,0,0,0,0,0\n", "bad.csv:2: column 'time': found '0', allowed: > 0");
  refuse(header, "bad.csv: holds no strained row");
  write("bad.csv", header + "0,0,0,0,0,0,0\n1,1e-3,0,0,1e-3,0,0\n");
  expect_refused("metal.prm bad.csv 'Path/Lateral=stress free'", "bad.csv: found a shear strain at time 1 s");
  expect_refused("metal.prm nowhere.csv", "nowhere.csv: does not exist");
}

TEST_F(MaterialPoint, UsesADamageTableAndRefusesBadOnes) {
  const Afc afc = wes5000();
  write_damage_table(cracking_cell(afc, 16e-3, 2.47 * MPa, 80), folder / "table.h5");
  write("cracking.prm", "include concrete.prm\nsubsection AFC\n set Damage table = table.h5\nend\n");
  expect_refused("cracking.prm path.csv", "key 'Path/Spacing' must be set");
  ASSERT_EQ(run("cracking.prm path.csv 'Path/Spacing=16 mm' --output result.csv --force"), 0)
      << read("stderr");
  EXPECT_GT(table("result.csv").at(2).at("tensile_damage"), 0);

  const std::string spacing = " 'Path/Spacing=16 mm'";
  expect_refused("cracking.prm path.csv AFC/C7=0.003" + spacing, "made for Young's modulus");
  // Cells that were not pulled, or not far enough.
  DamageTable pressed = cracking_cell(afc, 16e-3, 2.47 * MPa, 80), whole = pressed;
  std::swap(pressed.curves[0].psi_undamaged_plus, pressed.curves[0].psi_undamaged_minus);
  pressed.loading = "strain direction 0, -1, 0";
  write_damage_table(pressed, folder / "pressed.h5");
  expect_refused(
      "cracking.prm path.csv 'AFC/Damage table=pressed.h5'" + spacing,
      "pressed.h5': cell of 0.016 m under strain direction 0, -1, 0: found 0 % of its elastic energy in "
      "tension, allowed: more than 50 %");
  for (double& damage : whole.curves[0].damage_strength) damage = 0;
  write_damage_table(whole, folder / "whole.h5");
  expect_refused("cracking.prm path.csv 'AFC/Damage table=whole.h5'" + spacing,
                 "found no growth of the damage");
  ASSERT_EQ(
      run("cracking.prm path.csv 'AFC/Damage table=whole.h5' 'AFC/Damage definition=stiffness'" + spacing),
      0);
  fs::resize_file(folder / "table.h5", fs::file_size(folder / "table.h5") / 2);
  expect_refused("cracking.prm path.csv" + spacing, "damage table");
  fs::remove(folder / "table.h5");
  expect_refused("cracking.prm path.csv" + spacing, "table.h5");
}

TEST_F(MaterialPoint, ReplacesFilesOnlyIfForcedAndInputsNever) {
  ASSERT_EQ(run("metal.prm path.csv --output result.csv"), 0) << read("stderr");
  const std::string result = read("result.csv");
  expect_refused("metal.prm path.csv",
                 "holds results (result.csv"); // also if only one of the two files is there
  fs::remove(folder / "result.csv");
  EXPECT_EQ(run("metal.prm path.csv --output result.csv"), 2);
  EXPECT_FALSE(fs::exists(folder / "result.csv"));
  ASSERT_EQ(run("metal.prm path.csv --output result.csv --force"), 0) << read("stderr");
  EXPECT_EQ(read("result.csv"), result);

  const std::string path = read("path.csv"), metal = read("metal.prm");
  fs::rename(folder / "metal.prm", folder / "path2.csv.prm");
  write("metal.prm", "include path2.csv.prm\n");
  for (const char* words :
       {"metal.prm path.csv --output path.csv --force", "metal.prm path.csv --output ./path.csv --force",
        "metal.prm path.csv --output path2.csv --force"}) {
    EXPECT_EQ(run(words), 2) << words;
    EXPECT_NE(read("stderr").find("the input"), std::string::npos) << read("stderr");
  }
  EXPECT_EQ(read("path.csv"), path);
  EXPECT_EQ(read("path2.csv.prm"), metal);
}

TEST_F(MaterialPoint, WhatCannotBeWrittenIsCodeThree) {
  EXPECT_EQ(run("metal.prm path.csv > /dev/full"), 3);
  EXPECT_NE(read("stderr").find("standard output could not be written"), std::string::npos);
  EXPECT_EQ(run("--help > /dev/full"), 3);
  // Nobody would see the result.
  EXPECT_EQ(run("metal.prm path.csv >&-"), 2);
  EXPECT_NE(read("stderr").find("--output"), std::string::npos) << read("stderr");
  EXPECT_EQ(run("metal.prm path.csv --output result.csv >&- <&-"), 0);
  EXPECT_EQ(table("result.csv").size(), 3u);
}

TEST_F(MaterialPoint, APathFromASpreadsheetIsTheSamePath) {
  ASSERT_EQ(run("metal.prm path.csv --output result.csv"), 0);
  write("steel #1.prm", "include metal.prm\n");
  write("path#.csv",
        "\xEF\xBB\xBF\"Time\";EXX;eyy;ezz;exy;eyz;exz\r\n0;0;0;0;0;0;0\r\n+1e-3;+1e-4;0;0;0;0;0\r\n"
        "2e-3;2e-4;0;0;0;0;0\r\n");
  ASSERT_EQ(run("'steel #1.prm' path#.csv --output other#.csv"), 0) << read("stderr");
  EXPECT_EQ(read("other#.csv"), read("result.csv"));
  write("path#.csv", "time;exx;eyy;ezz;exy;eyz;exz\n0;0;0;0;0;0;0\n0,5;1e-4;0;0;0;0;0\n");
  expect_refused("metal.prm path#.csv",
                 "path#.csv:3: column 'time': found '0,5', allowed: a number with a decimal point");
}

TEST_F(MaterialPoint, HelpOnAKeyPrintsOnlyThatAndRefusesOthers) {
  ASSERT_EQ(run("--help AFC/C1"), 0);
  EXPECT_EQ(read("stdout").find("\nAFC\n  AFC/C1\n"), 0U) << read("stdout");
  EXPECT_NE(read("stdout").find("must be set if Law = AFC; allowed"), std::string::npos) << read("stdout");
  expect_refused("--help AFC/Densty", "did you mean 'AFC/Density'");
}

TEST_F(MaterialPoint, HelpNamesEveryConstantOfTableOne) {
  ASSERT_EQ(run("--help"), 0);
  const std::string help = read("stdout");
  for (const char* key : {"AFC/C1", "AFC/C9", "AFC/K3", "AFC/A_N", "AFC/T_max", "AFC/D1", "J2/Yield stress",
                          "Path/Substeps", "AFC/Failure strain floor"})
    EXPECT_NE(help.find(key), std::string::npos) << key;
}

} // namespace
} // namespace spall::test
