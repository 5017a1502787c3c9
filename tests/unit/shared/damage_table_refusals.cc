// Tests that invalid tables are refused with a message that names the table and the reason.

#include "shared/error.h"
#include "tests/unit/shared/sample_table.h"
#include "tests/unit/shared/scratch_folder.h"

#include <cmath>
#include <limits>

namespace spall::test {
namespace {

/// Returns the message of check() for a valid table after `spoil` has changed it.
template<class Spoil> std::string refusal_of(const Spoil& spoil) {
  DamageTable table = cracking_bar({8e-3, 16e-3});
  EXPECT_NO_THROW(check(table, "table"));
  spoil(table);
  return message_of<InputError>([&] { check(table, "table"); });
}

/// Returns the message of read_damage_table() for a file written by `writer`.
std::string refusal_of_file(const RawWriter& writer) {
  const ScratchFolder folder;
  writer(cracking_bar({8e-3}), folder / "bad.h5");
  const std::string message = message_of<InputError>([&] { read_damage_table(folder / "bad.h5"); });
  expect_one_line_with(message, {"bad.h5"});
  return message;
}

TEST(DamageTableCheck, RefusesNaNAndInfinity) {
  for (const DamageColumn& column : damage_columns)
    for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()})
      expect_one_line_with(refusal_of([&](DamageTable& t) { (t.curves[1].*column.values)[4] = bad; }),
                           {"table", std::string("'") + column.name + "'", "row 4"});
}

TEST(DamageTableCheck, RefusesColumnsOfUnequalLengthAndTooFewRows) {
  for (const DamageColumn& column : damage_columns)
    EXPECT_FALSE(refusal_of([&](DamageTable& t) { (t.curves[0].*column.values).pop_back(); }).empty())
        << column.name;
  expect_one_line_with(refusal_of([](DamageTable& t) {
                         for (const DamageColumn& column : damage_columns)
                           (t.curves[0].*column.values).resize(2);
                       }),
                       {"2 rows", "3"});
}

TEST(DamageTableCheck, RefusesAStrainThatDoesNotIncreaseFromZero) {
  expect_one_line_with(refusal_of([](DamageTable& t) { t.curves[0].strain[0] = 1e-9; }),
                       {"strain", "expected 0"});
  expect_one_line_with(refusal_of([](DamageTable& t) { t.curves[0].strain[5] = t.curves[0].strain[4]; }),
                       {"strain", "row 5"});
  expect_one_line_with(
      refusal_of([](DamageTable& t) { std::swap(t.curves[0].strain[5], t.curves[0].strain[6]); }),
      {"strain", "row 6"});
}

TEST(DamageTableCheck, RefusesDamageThatDecreasesOrLeavesItsRange) {
  for (const auto column :
       {&DamageCurve::damage, &DamageCurve::damage_strength, &DamageCurve::damage_renormalised}) {
    expect_one_line_with(
        refusal_of([&](DamageTable& t) { (t.curves[0].*column)[9] = (t.curves[0].*column)[8] - 1e-6; }),
        {"decreases", "row 9"});
    expect_one_line_with(refusal_of([&](DamageTable& t) { (t.curves[0].*column).back() = 1.001; }),
                         {"0 to 1", "1.001"});
    expect_one_line_with(refusal_of([&](DamageTable& t) { (t.curves[0].*column)[0] = -0.001; }),
                         {"0 to 1", "-0.001"});
  }
}

TEST(DamageTableCheck, RefusesWhatNoCellHas) {
  for (const auto column : {&DamageCurve::psi, &DamageCurve::psi_bulk, &DamageCurve::psi_cohesive,
                            &DamageCurve::psi_undamaged, &DamageCurve::opening})
    expect_one_line_with(
        refusal_of([&](DamageTable& t) { (t.curves[0].*column)[7] = -(t.curves[0].*column)[7] - 1; }),
        {"row 7", ">= 0"});
  expect_one_line_with(refusal_of([](DamageTable& t) { t.curves[0].dissipation.back() = 0; }),
                       {"dissipation"});
  expect_one_line_with(refusal_of([](DamageTable& t) {
                         for (double& stress : t.curves[0].stress) stress = 0;
                       }),
                       {"stress", "above 0"});
  expect_one_line_with(refusal_of([](DamageTable& t) { t.curves[0].stress[3] = 1e300; }),
                       {"stress", "row 3"});
  expect_one_line_with(refusal_of([](DamageTable& t) { t.curves[0].strain.back() = 1e10; }),
                       {"strain", "at most"});
}

TEST(DamageTableCheck, RefusesImpossibleConstants) {
  EXPECT_FALSE(
      refusal_of([](DamageTable& t) { t.youngs_modulus = std::numeric_limits<double>::infinity(); }).empty());
  EXPECT_FALSE(refusal_of([](DamageTable& t) { t.fracture_energy = 1e300; }).empty());
  EXPECT_FALSE(refusal_of([](DamageTable& t) { t.youngs_modulus = 0; }).empty());
  EXPECT_FALSE(refusal_of([](DamageTable& t) { t.poisson_ratio = 0.5; }).empty());
  EXPECT_FALSE(refusal_of([](DamageTable& t) { t.poisson_ratio = std::nan(""); }).empty());
  EXPECT_FALSE(refusal_of([](DamageTable& t) { t.tensile_strength = -1; }).empty());
  EXPECT_FALSE(refusal_of([](DamageTable& t) { t.fracture_energy = 0; }).empty());
  expect_one_line_with(refusal_of([](DamageTable& t) { t.curves.clear(); }), {"no curve"});
  expect_one_line_with(refusal_of([](DamageTable& t) { std::swap(t.curves[0], t.curves[1]); }),
                       {"ascending"});
}

TEST(DamageTableRead, RefusesMissingTruncatedAndForeignFiles) {
  const ScratchFolder folder;
  const auto reading = [&](const std::string& name) {
    return message_of<InputError>([&] { read_damage_table(folder / name); });
  };
  expect_one_line_with(reading("none.h5"), {"none.h5", "does not exist"});
  folder.write("text.h5", "no HDF5\n");
  expect_one_line_with(reading("text.h5"), {"text.h5"});
  write_damage_table(cracking_bar({8e-3}), folder / "whole.h5");
  const std::string whole = read_text(folder / "whole.h5");
  for (const double part : {0.0, 0.01, 0.1, 0.5, 0.9, 0.999}) {
    folder.write("part.h5",
                 whole.substr(0, static_cast<std::size_t>(part * static_cast<double>(whole.size()))));
    expect_one_line_with(reading("part.h5"), {"part.h5"});
  }
}

TEST(DamageTableRead, RefusesAnotherVersionAndOtherUnits) {
  RawWriter newer, imperial;
  newer.version = 3;
  imperial.units = "psi";
  expect_one_line_with(refusal_of_file(newer), {"version 3", "allowed: 2"});
  RawWriter older;
  older.version = 1;
  expect_one_line_with(refusal_of_file(older), {"version 1", "allowed: 2", "anew with microcell"});
  expect_one_line_with(refusal_of_file(imperial), {"psi", "SI"});
}

TEST(DamageTableRead, RefusesMissingAttributes) {
  for (const char* name : {"youngs_modulus", "poisson_ratio", "tensile_strength", "fracture_energy",
                           "softening", "crack_set", "boundary", "loading", "program", "input"}) {
    RawWriter writer;
    writer.skipped_attribute = name;
    expect_one_line_with(refusal_of_file(writer), {std::string("'") + name + "'", "missing"});
  }
}

TEST(DamageTableRead, RefusesEachMissingColumn) {
  for (const DamageColumn& column : damage_columns) {
    RawWriter writer;
    writer.column = [&](RawWriter::Column& c) { return c.name != column.name; };
    expect_one_line_with(refusal_of_file(writer), {column.name, "missing"});
  }
}

TEST(DamageTableRead, RefusesEachColumnInAnotherUnit) {
  for (const DamageColumn& column : damage_columns) {
    RawWriter writer;
    writer.column = [&](RawWriter::Column& c) {
      if (c.name == column.name) c.unit = "MPa";
      return true;
    };
    expect_one_line_with(refusal_of_file(writer), {column.name, "MPa", column.unit});
  }
}

TEST(DamageTableRead, RefusesAnExtraDimension) {
  for (const DamageColumn& column : damage_columns) {
    RawWriter writer;
    writer.column = [&](RawWriter::Column& c) {
      if (c.name == column.name)
        c.columns = 2, c.values.insert(c.values.end(), c.values.begin(), c.values.end());
      return true;
    };
    expect_one_line_with(refusal_of_file(writer), {column.name, "dimensions"});
  }
}

TEST(DamageTableRead, ChecksWhatItReads) {
  RawWriter decreasing, unknown;
  decreasing.column = [](RawWriter::Column& c) {
    if (c.name == "damage_strength") c.values[9] = 0;
    return true;
  };
  unknown.column = [](RawWriter::Column& c) {
    if (c.name == "stress") c.values[3] = std::nan("");
    return true;
  };
  expect_one_line_with(refusal_of_file(decreasing), {"damage_strength", "decreases", "0.008 m"});
  expect_one_line_with(refusal_of_file(unknown), {"stress", "row 3"});
}

TEST(DamageTableWrite, RefusesABadTableAndLeavesTheOldFile) {
  const ScratchFolder folder;
  write_damage_table(cracking_bar({8e-3}), folder / "t.h5");
  const std::string old = read_text(folder / "t.h5");
  DamageTable bad = cracking_bar({8e-3});
  bad.curves[0].damage[7] = 2;
  EXPECT_THROW(write_damage_table(bad, folder / "t.h5"), ComputationError); // no input is to blame
  EXPECT_EQ(read_text(folder / "t.h5"), old);
}

TEST(DamageTableConstants, MustBeThoseOfTheMaterial) {
  const DamageTable table = cracking_bar({8e-3});
  EXPECT_NO_THROW(check_elastic_constants(table, 18727e6, 0.3585, "scene.prm"));
  EXPECT_NO_THROW(check_elastic_constants(table, 18727e6 * 1.001, 0.3595, "scene.prm"));
  expect_one_line_with(
      message_of<InputError>([&] { check_elastic_constants(table, 18727e6 * 1.003, 0.3585, "scene.prm"); }),
      {"scene.prm", "Young"});
  expect_one_line_with(
      message_of<InputError>([&] { check_elastic_constants(table, 18727e6, 0.3555, "scene.prm"); }),
      {"scene.prm", "Poisson", "0.3585", "0.3555"});
}

TEST(DamageTableCheck, RefusesCellsThatWereNotPulled) {
  const auto strained = [](double share) {
    DamageTable table = cracking_bar({8e-3, 16e-3});
    table.loading = "strain direction 0, -1, 0";
    for (std::size_t i = 0; i < table.curves[1].strain.size(); ++i)
      table.curves[1].psi_undamaged_plus[i] = share * table.curves[1].psi_undamaged[i];
    return table;
  };
  const auto refusal = [&](double share) {
    return message_of<InputError>([&] { check_tension(strained(share), "table"); });
  };
  EXPECT_NO_THROW(check_tension(cracking_bar({8e-3, 16e-3}), "table"));
  expect_one_line_with(refusal(0),
                       {"table", "0.016 m", "strain direction 0, -1, 0", "0 %", "more than 50 %"});
  expect_one_line_with(refusal(0.5), {"50 % of"});        // shear
  EXPECT_NO_THROW(check_tension(strained(0.8), "table")); // uniaxial stress
}

} // namespace
} // namespace spall::test
