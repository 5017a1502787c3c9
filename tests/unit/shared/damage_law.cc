// Tests of the damage at any nodal spacing from the curve of a cell of one size.

#include "shared/damage_law.h"

#include "tests/unit/shared/sample_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace spall::test {
namespace {

constexpr double cell = 16e-3;

/// Returns the work per crack area, N/m, of a bar of length h that is elastic up to the threshold and then
/// carries strength * (1 - d): h times the integral of the stress over the strain until it is broken.
double crack_work(const DamageTable& table, const DamageLaw& law, double h, double last_strain) {
  const double E = table.oedometric_modulus(), f = table.tensile_strength, first = f / E;
  double work = 0.5 * f * first;
  const int steps = 200000;
  const double step = (last_strain - first) / steps;
  for (int i = 0; i < steps; ++i) work += f * (1 - law(first + (i + 0.5) * step)) * step;
  return h * work;
}

/// Returns the strain at which a bar of length h with that crack is broken: w_f / h.
double broken_strain(const DamageTable& table, double h) {
  return 2 * table.fracture_energy / table.tensile_strength / h;
}

TEST(DamageLaw, IsTheColumnItselfAtTheCellsOwnSize) {
  const DamageTable table = cracking_bar({cell});
  const DamageCurve& c = table.curves[0];
  const std::pair<DamageDefinition, const std::vector<double>*> columns[] = {
      {DamageDefinition::strength, &c.damage_strength},
      {DamageDefinition::stiffness, &c.damage},
      {DamageDefinition::stiffness_renormalised, &c.damage_renormalised}};
  for (const auto& [definition, values] : columns) {
    const DamageLaw law(table, cell, definition);
    for (std::size_t i = 0; i < c.strain.size(); ++i) EXPECT_NEAR(law(c.strain[i]), (*values)[i], 1e-9);
    EXPECT_NEAR(law(0.5 * (c.strain[5] + c.strain[6])), 0.5 * ((*values)[5] + (*values)[6]), 1e-9);
  }
}

TEST(DamageLaw, TheWorkPerCrackAreaIsTheFractureEnergyAtEverySpacing) {
  const DamageTable table = cracking_bar({cell});
  for (const double h : {cell / 4, cell / 2, 0.9 * cell, cell, 1.6 * cell, 4 * cell}) {
    const DamageLaw law(table, h, DamageDefinition::strength);
    EXPECT_NEAR(crack_work(table, law, h, broken_strain(table, h)), table.fracture_energy,
                1e-4 * table.fracture_energy)
        << "h = " << h;
  }
}

TEST(DamageLaw, WithoutRescalingTheWorkWouldGrowWithTheSpacing) {
  const DamageTable table = cracking_bar({cell});
  const DamageLaw law(table, cell, DamageDefinition::strength);
  EXPECT_GT(crack_work(table, law, 2 * cell, broken_strain(table, cell)), 1.9 * table.fracture_energy);
}

TEST(DamageLaw, ExponentialIsItsClosedForm) {
  const DamageLaw law = DamageLaw::exponential(6e-4, 1e-3);
  EXPECT_EQ(law.threshold(), 6e-4);
  EXPECT_EQ(law.strength_factor(), 1);
  EXPECT_EQ(law(0), 0);
  EXPECT_EQ(law(6e-4), 0);
  EXPECT_NEAR(law(1.6e-3), 1 - std::exp(-1.), 1e-15);
  EXPECT_NEAR(law(6e-4 + std::log(2.) * 1e-3), 0.5, 1e-15);
  EXPECT_EQ(law(std::numeric_limits<double>::max()), 1);
}

TEST(DamageLaw, TheCurveOfTheNearestSizeInRatioIsUsed) {
  // The crack of the small cell gets another strength curve than the size law predicts, so that the choice is
  // visible.
  DamageTable table = cracking_bar({4e-3, 16e-3});
  for (double& d : table.curves[0].damage_strength) d = d > 0 ? 1 : 0;
  const double strain = 0.2 * broken_strain(table, 8.1e-3);
  EXPECT_EQ(DamageLaw(table, 7.9e-3, DamageDefinition::strength)(strain), 1);
  EXPECT_LT(DamageLaw(table, 8.1e-3, DamageDefinition::strength)(strain), 0.5);
}

TEST(DamageLaw, OnlyTheStrengthDamageNeedsTheFactorOfTheWeakTable) {
  DamageTable table = cracking_bar({cell});
  table.curves[0].relative_strength = 0.8;
  EXPECT_EQ(DamageLaw(table, cell, DamageDefinition::strength).strength_factor(), 0.8);
  EXPECT_EQ(DamageLaw(table, cell, DamageDefinition::stiffness).strength_factor(), 1);
  EXPECT_EQ(DamageLaw(table, cell, DamageDefinition::stiffness_renormalised).strength_factor(), 1);
}

// Where tip zones soften before the peak, the energy that the cracks have dissipated lowers the stress of a
// larger cell.
TEST(DamageLaw, DissipationBeforeThePeakLowersTheStressOfALargerCell) {
  DamageTable table = cracking_bar({cell});
  DamageCurve& c = table.curves[0];
  // A row halfway to the peak is added; then 10 % of the work is dissipated at the peak row.
  for (const DamageColumn& column : damage_columns) {
    std::vector<double>& values = c.*column.values;
    values.insert(values.begin() + 1, 0.5 * values[1]);
  }
  const double spent = 0.1 * 0.5 * (c.stress[1] + c.stress[2]) * (c.strain[2] - c.strain[1]),
               peak = c.stress[2], share = spent / (c.strain[2] - c.strain[1]) / peak;
  c.dissipation[2] += spent;
  const double stiffness = 1 - peak / (table.oedometric_modulus() * c.strain[2]);
  EXPECT_NEAR(stiffness, 0, 1e-9);
  const DamageLaw larger(table, 3 * cell, DamageDefinition::stiffness);
  EXPECT_NEAR(larger(c.strain[2]), 1 - 1 / (1 + 2 * share), 1e-9);
  const DamageLaw same(table, cell, DamageDefinition::stiffness);
  EXPECT_NEAR(same(c.strain[2]), 0, 1e-9);
}

TEST(DamageLaw, NeverDecreasesStaysInRangeAndIsConstantBeyondTheEnd) {
  const DamageTable table = cracking_bar({cell});
  // At 60 times the cell size the rescaled curve snaps back.
  for (const double h : {cell / 10, cell, 60 * cell}) {
    const DamageLaw law(table, h, DamageDefinition::stiffness);
    double last = 0;
    for (double kappa = 0; kappa < 2 * broken_strain(table, h) + 1e-3; kappa += 1e-5) {
      EXPECT_GE(law(kappa), last);
      EXPECT_LE(law(kappa), 1);
      last = law(kappa);
    }
    EXPECT_EQ(law(1e3), law(1e6));
    EXPECT_NEAR(law(1e3), 1, 1e-9);
  }
}

TEST(DamageLaw, BreaksAtOnceWhereTheCurveSnapsBack) {
  const DamageTable table = cracking_bar({cell});
  const double h = 1000 * cell, peak = table.tensile_strength / table.oedometric_modulus();
  ASSERT_LT(broken_strain(table, h), peak);
  const DamageLaw law(table, h, DamageDefinition::strength);
  EXPECT_NEAR(law(1.0001 * peak), 1, 1e-9);
}

TEST(DamageLaw, ThresholdIsWhereDamageLeavesItsFirstValue) {
  const DamageTable table = cracking_bar({cell});
  for (const double h : {cell / 4, cell, 3 * cell}) {
    const DamageLaw law(table, h, DamageDefinition::strength);
    const double threshold = law.threshold();
    EXPECT_NEAR(threshold, table.tensile_strength / table.oedometric_modulus(), 1e-12);
    EXPECT_EQ(law(threshold), law(0));
    EXPECT_GT(law(threshold * 1.001), law(0));
  }
}

} // namespace
} // namespace spall::test
