// Tests that the damage table in data/tables is the one that its microcell case gives now.

#include "shared/damage_law.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>

namespace {

namespace fs = std::filesystem;

TEST(DamageTable, ShippedOneIsWhatTheMicrocellComputes) {
  const fs::path output = fs::temp_directory_path() / "spall_shipped_table";
  fs::remove_all(output);
  const std::string command = std::string(MICROCELL) + " " + SPALL_DATA +
                              "/microcells/wes5000.prm --output " + output.string() + " > /dev/null";
  ASSERT_EQ(std::system(command.c_str()), 0);
  const spall::DamageTable fresh = spall::read_damage_table(output / "damage_table.h5");
  const spall::DamageTable shipped = spall::read_damage_table(fs::path(SPALL_DATA) / "tables" / "wes5000.h5");
  EXPECT_DOUBLE_EQ(shipped.youngs_modulus, fresh.youngs_modulus);
  EXPECT_DOUBLE_EQ(shipped.poisson_ratio, fresh.poisson_ratio);
  EXPECT_DOUBLE_EQ(shipped.fracture_energy, fresh.fracture_energy);
  ASSERT_EQ(shipped.curves.size(), fresh.curves.size());
  for (std::size_t c = 0; c < fresh.curves.size(); ++c) {
    EXPECT_DOUBLE_EQ(shipped.curves[c].cell_size, fresh.curves[c].cell_size);
    // The rows may have different strains, so the damage laws that the macroscopic model makes from them are
    // compared.
    for (const auto definition : {spall::DamageDefinition::strength, spall::DamageDefinition::stiffness}) {
      const spall::DamageLaw a(shipped, fresh.curves[c].cell_size, definition);
      const spall::DamageLaw b(fresh, fresh.curves[c].cell_size, definition);
      for (const double strain : fresh.curves[c].strain) // row by row: a maximum would skip NaN
        ASSERT_LT(std::abs(a(strain) - b(strain)), 1e-3) << "cell of " << fresh.curves[c].cell_size << " m";
    }
  }
  fs::remove_all(output);
}

} // namespace
