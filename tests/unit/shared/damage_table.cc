#include "shared/damage_table.h"

#include "shared/error.h"
#include "tests/unit/shared/sample_table.h"
#include "tests/unit/shared/scratch_folder.h"
#include "tests/unit/shared/small_disk.h"

#include <sstream>

namespace spall::test {
namespace {

void expect_equal(const DamageTable& a, const DamageTable& b) {
  EXPECT_EQ(a.youngs_modulus, b.youngs_modulus);
  EXPECT_EQ(a.poisson_ratio, b.poisson_ratio);
  EXPECT_EQ(a.tensile_strength, b.tensile_strength);
  EXPECT_EQ(a.fracture_energy, b.fracture_energy);
  EXPECT_EQ(a.softening, b.softening);
  EXPECT_EQ(a.crack_set, b.crack_set);
  EXPECT_EQ(a.boundary, b.boundary);
  EXPECT_EQ(a.loading, b.loading);
  EXPECT_EQ(a.provenance.program, b.provenance.program);
  EXPECT_EQ(a.provenance.input_file, b.provenance.input_file);
  EXPECT_EQ(a.provenance.created, b.provenance.created);
  EXPECT_EQ(a.provenance.input, b.provenance.input);
  ASSERT_EQ(a.curves.size(), b.curves.size());
  for (std::size_t i = 0; i < a.curves.size(); ++i) {
    EXPECT_EQ(a.curves[i].cell_size, b.curves[i].cell_size);
    EXPECT_EQ(a.curves[i].relative_strength, b.curves[i].relative_strength);
    EXPECT_EQ(a.curves[i].psi_stress_error, b.curves[i].psi_stress_error);
    EXPECT_EQ(a.curves[i].psi_work_error, b.curves[i].psi_work_error);
    for (const DamageColumn& column : damage_columns)
      EXPECT_EQ(a.curves[i].*column.values, b.curves[i].*column.values) << column.name << " of curve " << i;
  }
}

TEST(DamageTable, WhatIsWrittenIsReadBackBitForBit) {
  const ScratchFolder folder;
  // With eleven curves the names in the file sort differently from the numbers.
  std::vector<double> sizes;
  for (int i = 1; i <= 11; ++i) sizes.push_back(4e-3 * i);
  DamageTable table = cracking_bar(sizes);
  table.curves[3].relative_strength = 0.9;
  table.curves[4].psi_stress_error = 1e-11;
  table.curves[5].psi_work_error = 1e-5;
  write_damage_table(table, folder / "t.h5");
  expect_equal(read_damage_table(folder / "t.h5"), table);
}

TEST(DamageTable, AFileWrittenFromTheFormatAloneIsRead) {
  const ScratchFolder folder;
  const DamageTable table = cracking_bar({8e-3, 16e-3});
  RawWriter()(table, folder / "t.h5");
  expect_equal(read_damage_table(folder / "t.h5"), table);
}

TEST(DamageTable, TheCsvTwinHoldsTheSameNumbers) {
  const ScratchFolder folder;
  const DamageTable table = cracking_bar({8e-3, 16e-3}, 5);
  write_damage_csv(table, folder / "t.csv");
  std::ifstream stream(folder / "t.csv");
  std::string line, header;
  std::size_t comments = 0, row = 0, curve = 0;
  while (std::getline(stream, line)) {
    if (line.starts_with("#")) {
      ++comments;
    } else if (header.empty()) {
      header = line;
      EXPECT_EQ(header.substr(0, 23), "cell_size,strain,stress");
    } else {
      if (row == table.curves[curve].strain.size()) row = 0, ++curve;
      std::stringstream cells(line);
      std::string cell;
      ASSERT_TRUE(std::getline(cells, cell, ','));
      EXPECT_EQ(std::stod(cell), table.curves[curve].cell_size);
      for (const DamageColumn& column : damage_columns) {
        ASSERT_TRUE(std::getline(cells, cell, ',')) << column.name;
        EXPECT_EQ(std::stod(cell), (table.curves[curve].*column.values)[row]) << column.name;
      }
      ++row;
    }
  }
  EXPECT_GE(comments, 1u);
  EXPECT_EQ(curve, 1u);
  EXPECT_EQ(row, table.curves[1].strain.size());
}

TEST(DamageTable, AFullDiskLeavesTheGoodTableAndNothingElse) {
  const ScratchFolder folder;
  DamageTable table = cracking_bar({0.01, 0.02});
  write_damage_table(table, folder / "table.h5");
  const std::string good = read_text(folder / "table.h5");
  table.tensile_strength *= 2;
  for (const std::size_t room : {good.size() / 4, good.size() / 2, good.size() - 1}) {
    const SmallDisk full(room);
    expect_one_line_with(message_of<OutputError>([&] { write_damage_table(table, folder / "table.h5"); }),
                         {"table.h5", "room"});
  }
  EXPECT_EQ(read_text(folder / "table.h5"), good);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path), {}), 1);
  write_damage_table(table, folder / "table.h5");
  EXPECT_EQ(read_damage_table(folder / "table.h5").tensile_strength, table.tensile_strength);
}

TEST(DamageTable, TheOedometricModulusIsBulkPlusFourThirdsShear) {
  DamageTable table;
  table.youngs_modulus = 18727e6, table.poisson_ratio = 0.3585;
  const double bulk = 18727e6 / (3 * (1 - 2 * 0.3585)), shear = 18727e6 / (2 * 1.3585);
  EXPECT_NEAR(table.oedometric_modulus(), bulk + 4. / 3 * shear, 1e-6 * bulk);
}

} // namespace
} // namespace spall::test
