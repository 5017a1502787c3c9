#include "tests/unit/material/cracking_cell.h"

#include <gtest/gtest.h>

namespace spall::test {
namespace {

constexpr double fracture_energy = 80, cell = 16e-3; // N/m, m
constexpr double dt = 1e-6;

/// All tests hold for both definitions of kappa.
class TensileDamage : public ::testing::TestWithParam<const char*> {
protected:
  Afc cracking(double spacing, std::vector<std::string> changes = {}) {
    changes.push_back(GetParam());
    Afc afc = wes5000(changes);
    afc.tensile.use(cracking_cell(afc, cell, 2.47 * MPa, fracture_energy), {spacing});
    return afc;
  }
};
INSTANTIATE_TEST_SUITE_P(Kappa, TensileDamage,
                         ::testing::Values("AFC/Damage strain=total", "AFC/Damage strain=tensile"),
                         [](const auto& reading) { return std::string(reading.param).substr(18); });

/// Applies tension in uniaxial strain. @return work per volume, J/m^3
double pull(SinglePoint<Afc>& point, double strain, int steps) {
  for (int i = 0; i < steps; ++i) point.advance({strain / steps, 0, 0, 0, 0, 0}, dt);
  return point.work;
}

TEST_P(TensileDamage, EnergyPerCrackAreaIsThatOfTheTableAtAnySpacing) {
  // Full opening 65 um. The law agrees with the table except between 0.8e-4 and 1.1e-4, where the deviator
  // adds its share to the mean stress: an energy per volume, so its share falls with the spacing.
  const double spacings[] = {16e-3, 8e-3, 4e-3}, tolerances[] = {0.03, 0.015, 0.008};
  for (int i = 0; i < 3; ++i) {
    const Afc afc = cracking(spacings[i]);
    SinglePoint point(afc);
    const double work = pull(point, 70e-6 / spacings[i], 40000) * spacings[i];
    EXPECT_NEAR(point.state.tensile_damage, 1, 1e-9);
    EXPECT_NEAR(work, fracture_energy, tolerances[i] * fracture_energy) << "spacing " << spacings[i];
  }
}

TEST_P(TensileDamage, AfterThePeakTheStressIsThatOfTheTable) {
  const Afc afc = cracking(cell);
  const DamageTable table = cracking_cell(afc, cell, 2.47 * MPa, fracture_energy);
  SinglePoint point(afc);
  pull(point, 5e-4, 5000);
  for (int i = 0; i < 30; ++i) {
    pull(point, 1e-4, 100);
    // Softening line of the layer: strain = s / E + w_f / l (1 - s / f), s = 0 beyond.
    const double E = table.oedometric_modulus(), f = 2.47 * MPa, end = 2 * fracture_energy / f / cell;
    const double stress = std::max(0., (end - point.strain[0]) / (end / f - 1 / E));
    EXPECT_NEAR(point.stress[0], stress, 1e-3 * f);
  }
}

TEST_P(TensileDamage, TheStiffnessReadingDissipatesFarLess) {
  const Afc literal = cracking(cell, {"AFC/Damage definition=stiffness"});
  SinglePoint point(literal);
  EXPECT_LT(pull(point, 5e-3, 40000) * cell, 0.3 * fracture_energy);
}

TEST_P(TensileDamage, CompressionNeverTriggersIt) {
  const Afc afc = cracking(cell);
  SinglePoint hydrostatic(afc), uniaxial(afc), confined(afc), free(afc);
  for (int i = 0; i < 2000; ++i) {
    hydrostatic.advance({-1e-4, -1e-4, -1e-4, 0, 0, 0}, dt);
    uniaxial.advance({-1e-4, 0, 0, 0, 0, 0}, dt);
    confined.advance({-1e-4, 3e-5, 3e-5, 0, 0, 0}, dt); // the lateral strain is far above the threshold
  }
  for (int i = 0; i < 900; ++i) free.advance_with_free_sides(-1e-5, 1e-2);
  for (const SinglePoint<Afc>* point : {&hydrostatic, &uniaxial, &confined, &free})
    EXPECT_EQ(point->state.tensile_damage, 0);
  EXPECT_GT(confined.strain[1], 0.05);
  EXPECT_GT(free.strain[1], 4e-3);            // 50 times the threshold
  EXPECT_GT(free.state.plastic_strain, 5e-3); // beyond the peak,
  EXPECT_LT(free.stress[0], -5 * MPa);        // but some strength is left
}

TEST_P(TensileDamage, PureShearCountsHalf) {
  // Principal stresses +-s: weight 1/2; principal strains +-e. Strength 24.75 MPa is not reached before.
  const Afc afc = cracking(cell);
  SinglePoint point(afc);
  point.advance({0, 0, 0, 1e-3, 0, 0}, 1);
  EXPECT_NEAR(point.state.tensile_strain, 0.5 * 1e-3, 1e-9);
}

TEST_P(TensileDamage, FollowsTheLargestStrainAndDoesNotHeal) {
  const Afc afc = cracking(cell);
  SinglePoint point(afc);
  pull(point, 1e-3, 1000);
  const double damage = point.state.tensile_damage;
  EXPECT_NEAR(point.state.tensile_strain, 1e-3, 1e-5);
  pull(point, -1.5e-3, 1500);
  EXPECT_EQ(point.state.tensile_damage, damage);
}

TEST_P(TensileDamage, HasNoEffectOnCompressionAfterClosing) {
  const Afc with = cracking(cell, {"AFC/Shear damage=no"}), without = wes5000({"AFC/Shear damage=no"});
  SinglePoint a(with), b(without);
  pull(a, 6e-3, 1000); // broken
  EXPECT_NEAR(a.state.tensile_damage, 1, 1e-9);
  EXPECT_NEAR(equivalent_stress(a.stress), 0, 1);
  pull(b, 6e-3, 1000);
  for (SinglePoint<Afc>* point : {&a, &b}) pull(*point, -26e-3, 4000);
  EXPECT_SAME_STRESS(a.stress, b.stress, 1e-3 * MPa);
  EXPECT_LT(a.stress[0], -100 * MPa);
}

TEST_P(TensileDamage, OpenPointLosesItsStabilisingStiffness) {
  const Afc afc = cracking(cell);
  SinglePoint point(afc);
  pull(point, 6e-3, 1000);
  const Stiffness open = point.advance({1e-6, 0, 0, 0, 0, 0}, dt);
  EXPECT_NEAR(open.bulk, 0, 1e-6);
  EXPECT_NEAR(open.shear, 0, 1);
  pull(point, -8e-3, 1000);
  EXPECT_GT(point.advance({-1e-6, 0, 0, 0, 0, 0}, dt).bulk, 0.9 * afc.bulk_modulus());
}

TEST_P(TensileDamage, InitialDamageOfTheLiteralReadingWeakensFromTheStart) {
  const Afc plain = wes5000();
  DamageTable table = cracking_cell(plain, cell, 2.47 * MPa, fracture_energy);
  for (double& d : table.curves[0].damage) d = 0.128 + (1 - 0.128) * d;
  Afc afc = wes5000({"AFC/Damage definition=stiffness"});
  afc.tensile.use(table, {cell});
  SinglePoint point(afc);
  point.advance(Sym3{}, dt);
  EXPECT_NEAR(point.state.tensile_damage, 0.128, 1e-12);
}

// With the weak and strong tables of an ensemble, peak and dissipated energy are those of the table, not of
// the mean.
TEST_P(TensileDamage, WeakTableMakesWeakConcreteStrongTableStrong) {
  const auto tabulated = [](double relative_strength) {
    Afc afc = wes5000();
    DamageTable table = cracking_cell(afc, cell, 2.47 * MPa, fracture_energy);
    table.curves[0].relative_strength = relative_strength;
    afc.tensile.use(table, {4e-3});
    SinglePoint point(afc);
    double peak = 0, work = 0;
    for (int i = 0; i < 20000; ++i) {
      work = pull(point, 20e-3 / 20000, 1);
      peak = std::max(peak, trace(point.stress) / 3);
    }
    return std::pair(peak, work * 4e-3);
  };
  const auto [weak_peak, weak] = tabulated(0.85);
  const auto [mean_peak, mean] = tabulated(1);
  const auto [strong_peak, strong] = tabulated(1.15);
  // The peaks are compared with the limit of mean tension; the strong one is reached after damage has begun.
  EXPECT_NEAR(weak_peak, 0.85 * 2.47 * MPa, 0.01 * MPa);
  EXPECT_NEAR(mean_peak, 2.47 * MPa, 0.01 * MPa);
  EXPECT_NEAR(strong_peak, 1.15 * 2.47 * MPa, 0.03 * MPa);
  // The final opening is the same, so the energy is proportional to the strength.
  EXPECT_NEAR(mean, fracture_energy, 0.02 * fracture_energy);
  EXPECT_NEAR(weak, 0.85 * mean, 0.02 * mean);
  EXPECT_NEAR(strong, 1.15 * mean, 0.02 * mean);
}

TEST_P(TensileDamage, RateFactorRaisesStrengthAndEnergyAlike) {
  const Afc afc = cracking(4e-3, {"AFC/Tensile rate factor=3"});
  SinglePoint point(afc);
  const double threshold = 2.47 * MPa / cracking_cell(afc, cell, 2.47 * MPa, 80).oedometric_modulus();
  pull(point, 3 * threshold * 0.999, 1000);
  EXPECT_EQ(point.state.tensile_damage, 0);
  pull(point, 3 * threshold * 0.01, 1000);
  EXPECT_GT(point.state.tensile_damage, 0);
  EXPECT_NEAR(pull(point, 20e-3, 40000) * 4e-3, 3 * fracture_energy, 0.03 * 3 * fracture_energy);
}

// Set G3 of the verification: in uniaxial strain the mean tension follows 7.41 MPa (1 - d_t) for any spacing,
// after the elastic line has reached it.
TEST(VerificationSet, ExponentialLawOfG3) {
  Afc afc = concrete("wes5000_g3");
  afc.prepare({}); // the spacing is not needed
  EXPECT_FALSE(afc.shear.active);
  SinglePoint point(afc);
  for (const double strain : {1e-4, 3e-4, 6e-4, 1.2e-3, 3e-3, 6e-3}) {
    pull(point, strain - point.strain[0], 1000);
    const double damage = strain < 6e-4 ? 0 : 1 - std::exp(-(strain - 6e-4) / 1e-3);
    EXPECT_NEAR(point.state.tensile_damage, damage, 1e-9);
    const double mu = std::exp(-strain) - 1; // density over the initial one, less 1
    EXPECT_NEAR(trace(point.stress) / 3, std::min(-afc.bulk_modulus() * mu, 7.41 * MPa * (1 - damage)), 1);
  }
}

TEST_P(TensileDamage, DoesNotDependOnTheFrame) {
  const Afc afc = cracking(cell);
  const Mat3 r = rotation();
  SinglePoint point(afc), rotated(afc);
  RandomStrain strain(3e-5);
  for (int i = 0; i < 200; ++i) {
    const Sym3 e = strain();
    point.advance(e, dt);
    rotated.advance(rotate(r, e), dt);
  }
  EXPECT_GT(point.state.tensile_damage, 0);
  EXPECT_NEAR(rotated.state.tensile_damage, point.state.tensile_damage, 1e-8);
  EXPECT_SAME_STRESS(rotated.stress, rotate(r, point.stress), 1e-6 * MPa);
}

} // namespace
} // namespace spall::test
