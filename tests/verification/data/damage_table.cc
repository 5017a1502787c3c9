// Tests that the damage tables in data/tables are those that their microcell cases give now.

#include "shared/damage_law.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>

namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The table `fresh_file` is, as a damage law, data/tables/`shipped`.h5.
void expect_same(const fs::path& fresh_file, const std::string& shipped_name) {
  const spall::DamageTable fresh = spall::read_damage_table(fresh_file);
  const spall::DamageTable shipped =
      spall::read_damage_table(fs::path(SPALL_DATA) / "tables" / (shipped_name + ".h5"));
  EXPECT_DOUBLE_EQ(shipped.youngs_modulus, fresh.youngs_modulus);
  EXPECT_DOUBLE_EQ(shipped.poisson_ratio, fresh.poisson_ratio);
  EXPECT_DOUBLE_EQ(shipped.fracture_energy, fresh.fracture_energy);
  ASSERT_EQ(shipped.curves.size(), fresh.curves.size());
  for (std::size_t c = 0; c < fresh.curves.size(); ++c) {
    EXPECT_DOUBLE_EQ(shipped.curves[c].cell_size, fresh.curves[c].cell_size);
    EXPECT_NEAR(shipped.curves[c].relative_strength, fresh.curves[c].relative_strength, 1e-3);
    // The rows may have different strains, so the damage laws that the macroscopic model makes from them are
    // compared.
    for (const auto definition : {spall::DamageDefinition::strength, spall::DamageDefinition::stiffness}) {
      const spall::DamageLaw a(shipped, fresh.curves[c].cell_size, definition);
      const spall::DamageLaw b(fresh, fresh.curves[c].cell_size, definition);
      for (const double strain : fresh.curves[c].strain) // row by row: a maximum would skip NaN
        ASSERT_LT(std::abs(a(strain) - b(strain)), 1e-3) << "cell of " << fresh.curves[c].cell_size << " m";
    }
  }
}

/// The table that `command` writes into the folder `cells` is data/tables/`shipped`.h5.
void expect_shipped(const std::string& command, const fs::path& cells, const std::string& shipped_name) {
  ASSERT_EQ(std::system((command + " > /dev/null").c_str()), 0) << command;
  expect_same(cells / "damage_table.h5", shipped_name);
}

TEST(DamageTable, ShippedOneIsWhatTheMicrocellComputes) {
  const fs::path output = fs::temp_directory_path() / "spall_shipped_table";
  fs::remove_all(output);
  expect_shipped(std::string(MICROCELL) + " " + SPALL_DATA + "/microcells/wes5000.prm --output " +
                     output.string(),
                 output, "wes5000");
  fs::remove_all(output);
}

TEST(DamageTable, WeakAndStrongOnesAreThoseOfTheEnsemble) {
  const fs::path output = fs::temp_directory_path() / "spall_ensemble";
  fs::remove_all(output);
  const std::string command =
      std::string(MICROCELL) + " " + SPALL_DATA + "/microcells/ensemble.prm --output " + output.string();
  ASSERT_EQ(std::system((command + " > /dev/null").c_str()), 0) << command;
  for (const std::string name : {"weak", "strong"})
    expect_same(output / ("damage_table_" + name + ".h5"), "wes5000_" + name);
  fs::remove_all(output);
}

/// Concretes of other strengths follow from the reference by rules: their files are what `shared/concrete`
/// makes.
TEST(DamageTable, ConcretesOfOtherStrengthsAreThoseOfTheirRules) {
  for (const auto& [strength, density] : {std::pair(35, 2370), std::pair(30, 2350)}) {
    const std::string name = "concrete_" + std::to_string(strength);
    const fs::path output = fs::temp_directory_path() / ("spall_" + name);
    fs::remove_all(output);
    expect_shipped(std::string(SPALL_DATA) + "/../shared/concrete --strength '" + std::to_string(strength) +
                       " MPa' --aggregate '9.5 mm' --density '" + std::to_string(density) +
                       " kg/m3' --run --build " + SPALL_BUILD + " --output " + output.string(),
                   output / "microcell", name);
    EXPECT_EQ(text_of(output / "concrete.prm"),
              text_of(fs::path(SPALL_DATA) / "materials" / (name + ".prm")));
    fs::remove_all(output);
  }
}

} // namespace
