#include "micro/inputs.h"
#include "micro/output/curve_file.h"
#include "micro/output/energy_report.h"
#include "shared/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace {

using namespace spall;

MicrocellInputs case_a() {
  MicrocellInputs inputs;
  inputs.youngs_modulus = 18727e6;
  inputs.poisson_ratio = 0.3585;
  inputs.strength = 3e6;
  inputs.fracture_energy = 80;
  inputs.sizes = {0.016};
  inputs.reference_size = 0.016;
  inputs.geometry.crack_ratio = 0.25;
  return inputs;
}

std::string refusal(const MicrocellInputs& inputs) {
  try {
    check(inputs, "case.prm");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(MicrocellInputs, ReferenceCaseIsAccepted) { EXPECT_EQ(refusal(case_a()), ""); }

TEST(MicrocellInputs, SizesMustAscendAndHoldTheReference) {
  MicrocellInputs inputs = case_a();
  inputs.sizes = {0.02, 0.016};
  EXPECT_NE(refusal(inputs).find("case.prm: key 'Cell/Sizes'"), std::string::npos);
  inputs.sizes = {0.02, 0.04};
  EXPECT_NE(refusal(inputs).find("'Cell/Reference size': found 0.016 m"), std::string::npos);
  inputs.sizes = {};
  EXPECT_NE(refusal(inputs).find("must be set"), std::string::npos);
}

TEST(MicrocellInputs, ImpossibleAggregatesAreRefused) {
  MicrocellInputs inputs = case_a();
  inputs.geometry.crack_ratio = 0;
  inputs.aggregates.grading = {.fraction = 0.4, .smallest = 0.003, .largest = 0.0095};
  inputs.aggregates.zone_strength = inputs.aggregates.zone_energy = 0.5;
  EXPECT_EQ(refusal(inputs), "");
  // There are two laws for each aggregate; those of the interface zones come first.
  const auto laws = inputs.line_laws(0.016);
  EXPECT_EQ(laws.size(), 2 * aggregate_diameters(inputs.aggregates.grading, 0.016).size());
  EXPECT_DOUBLE_EQ(laws.front()->strength(), 0.5 * laws.back()->strength());

  const auto refused = [](MicrocellInputs changed, auto change, const char* key) {
    change(changed);
    EXPECT_NE(refusal(changed).find(key), std::string::npos) << refusal(changed);
  };
  refused(
      inputs, [](auto& i) { i.aggregates.grading.largest = 0.002; }, "'Aggregates/Smallest diameter'");
  refused(
      inputs, [](auto& i) { i.aggregates.grading.largest = 0.02; }, "'Cell/Sizes'");
  refused(
      inputs, [](auto& i) { i.geometry.crack_ratio = 0.1; }, "'Cell/Initial crack'");
  refused(
      inputs, [](auto& i) { i.boundary = Boundary::uniform_traction; }, "'Cell/Boundary'");
  refused(
      inputs, [](auto& i) { i.fracture_energy = 2; }, "'Aggregates/Refinements'");
  refused(
      inputs,
      [](auto& i) {
        i.aggregates.scaled = false;
        i.ensemble.samples = 2;
      },
      "'Aggregates/Scale to the material'");
}

// The process zone of a brittle, large or strong cell needs more elements; the message names a sufficient
// number.
TEST(MicrocellInputs, UnresolvedProcessZoneIsRefusedWithTheMeshToUse) {
  MicrocellInputs inputs = case_a();
  inputs.sizes = {0.2};
  inputs.reference_size = 0.2;
  const std::string message = refusal(inputs);
  const std::string advice = "set Mesh/Elements to ";
  const auto at = message.find(advice);
  ASSERT_NE(at, std::string::npos) << message;
  inputs.mesh.elements = std::stoi(message.substr(at + advice.size()));
  EXPECT_EQ(refusal(inputs), "");
  --inputs.mesh.elements;
  EXPECT_NE(refusal(inputs), "");
  inputs.sizes = {1000};
  inputs.reference_size = 1000;
  EXPECT_NE(refusal(inputs).find("use smaller cells"), std::string::npos);
}

// Each key of a strain direction must set the component that it names: xx, yy, xy in 2D; xx, yy, zz, xy, yz,
// xz in 3D, as in the macroscopic program.
TEST(MicrocellInputs, StrainDirectionHasItsComponentsInTheOrderOfTheirNames) {
  MicrocellInputs inputs = case_a();
  inputs.load_mode = LoadMode::direction;
  inputs.strain_xx = 1, inputs.strain_yy = 2, inputs.strain_zz = 3;
  inputs.strain_xy = 4, inputs.strain_yz = 5, inputs.strain_xz = 6;
  const auto check_order = [](const auto& direction, const std::vector<std::string>& names,
                              const std::vector<double>& values, const auto& index) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      const auto [row, column] = index(static_cast<int>(i));
      EXPECT_EQ(std::string() + "xyz"[row] + "xyz"[column], names[i]);
      EXPECT_EQ(direction[static_cast<Eigen::Index>(i)], values[i]) << names[i];
    }
  };
  check_order(inputs.load<2>().direction, {"xx", "yy", "xy"}, {1, 2, 4}, tensor_index<2>);
  check_order(inputs.load<3>().direction, {"xx", "yy", "zz", "xy", "yz", "xz"}, {1, 2, 3, 4, 5, 6},
              tensor_index<3>);
}

TEST(CurveFile, HasTheDocumentedColumnsAndMarksAnIncompleteCurve) {
  DamageCurve curve;
  for (const DamageColumn& column : damage_columns) curve.*column.values = {0, 0.125};
  const auto file = std::filesystem::temp_directory_path() / "spall_test_curve.csv";
  write_curve(curve, "stopped at strain 0.125", file);
  std::ifstream stream(file);
  std::string header, first, second, mark, rest;
  std::getline(stream, header);
  std::getline(stream, first);
  std::getline(stream, second);
  std::getline(stream, mark);
  EXPECT_EQ(
      header,
      "strain,stress,psi_bulk,psi_cohesive,psi,psi_undamaged,damage,damage_path,damage_strength,"
      "damage_renormalised,opening,dissipation,work,psi_undamaged_plus,psi_undamaged_minus,damage_plus");
  EXPECT_EQ(
      second,
      "0.125,0.125,0.125,0.125,0.125,0.125,0.125,0.125,0.125,0.125,0.125,0.125,0.125,0.125,0.125,0.125");
  EXPECT_EQ(mark, "# incomplete: stopped at strain 0.125");
  EXPECT_FALSE(std::getline(stream, rest));
  std::filesystem::remove(file);
}

// damage_plus satisfies Eq. 28, psi = (1 - d) Psi0+ + Psi0-, at every strain and as the limit at strain 0, in
// tension and compression.
TEST(DamagePlus, IsTheDamageOfTheTensileEnergy) {
  const SplitEnergy unit{.plus = 3e10, .minus = 1e10};
  DamageCurve curve;
  curve.strain = {0, 1e-4, 2e-4, -1e-4};
  curve.damage = {0.2, 0.2, 0.5, 0.1};
  for (std::size_t i = 0; i < 4; ++i) {
    curve.psi_undamaged.push_back(4e10 * curve.strain[i] * curve.strain[i]);
    curve.psi.push_back((1 - curve.damage[i]) * curve.psi_undamaged[i]);
  }
  set_damage_plus(curve, unit);
  for (std::size_t i = 1; i < 4; ++i) {
    EXPECT_DOUBLE_EQ(curve.psi_undamaged_plus[i] + curve.psi_undamaged_minus[i], curve.psi_undamaged[i]);
    EXPECT_NEAR((1 - curve.damage_plus[i]) * curve.psi_undamaged_plus[i] + curve.psi_undamaged_minus[i],
                curve.psi[i], 1e-12 * curve.psi[i]);
  }
  EXPECT_NEAR(curve.damage_plus[0], curve.damage_plus[1], 1e-12);
  EXPECT_GT(curve.psi_undamaged_minus[3], curve.psi_undamaged_plus[3]);
}

// Jammed fragments make a cell stiffer again, but damage in a table must not decrease.
TEST(Envelope, KeepsTheLargestDamage) {
  DamageCurve curve;
  curve.strain = {0, 1, 2, 3};
  curve.damage = {0, 0.5, 0.4, 0.9};
  curve.damage_strength = {0, 0, 0.7, 0.6};
  curve.damage_renormalised = {0, 0.2, 0.3, 0.8};
  const DamageCurve table = envelope(curve);
  EXPECT_EQ(table.strain, curve.strain);
  EXPECT_EQ(table.damage, (std::vector<double>{0, 0.5, 0.5, 0.9}));
  EXPECT_EQ(table.damage_strength, (std::vector<double>{0, 0, 0.7, 0.7}));
  EXPECT_EQ(table.damage_renormalised, curve.damage_renormalised);
}

TEST(EnergyReport, CautionsAgainstErrorsBeyondTheTolerance) {
  const auto report = [](const EnergyChecks& checks, bool friction, const char* passed) {
    Summary summary;
    testing::internal::CaptureStdout();
    report_energies(checks, friction, summary);
    EXPECT_NE(summary.json().find(std::string("\"energy_checks_passed\": ") + passed), std::string::npos);
    return testing::internal::GetCapturedStdout();
  };
  EXPECT_EQ(report({1e-9, 1e-5}, false, "true").find("caution"), std::string::npos);
  EXPECT_NE(report({1e-5, 1e-5}, false, "false").find("caution: states are not in equilibrium"),
            std::string::npos);
  EXPECT_NE(report({1e-9, 1e-2}, false, "false").find("caution: rows are too far apart"), std::string::npos);
  EXPECT_EQ(report({1e-2, 1e-5}, true, "true").find("caution"), std::string::npos);
}

} // namespace
