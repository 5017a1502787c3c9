// Tests of the strain measure that drives kappa, the history variable of tensile damage.

#include "tests/unit/material/cracking_cell.h"

#include <gtest/gtest.h>

namespace spall::test {
namespace {

constexpr double cell = 16e-3, dt = 1e-6;

Afc cracking(const std::vector<std::string>& changes) {
  Afc afc = wes5000(changes);
  afc.tensile.use(cracking_cell(afc, cell, 2.47 * MPa, 80), {cell});
  return afc;
}
const std::string total = "AFC/Damage strain=total", tensile = "AFC/Damage strain=tensile";

class MonotonicPull : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(DamageStrain, MonotonicPull,
                         ::testing::Values("AFC/Opened volume kept=0", "AFC/Opened volume kept=0.4",
                                           "AFC/Opened volume kept=1"));

TEST_P(MonotonicPull, BothReadingsAreItsStrain) {
  const Afc a = cracking({total, GetParam()}), b = cracking({tensile, GetParam()});
  SinglePoint strain_a(a), strain_b(b), stress_a(a), stress_b(b);
  for (int i = 0; i < 1000; ++i) {
    strain_a.advance({2e-6, 0, 0, 0, 0, 0}, dt);
    strain_b.advance({2e-6, 0, 0, 0, 0, 0}, dt);
    stress_a.advance_with_free_sides(2e-6, dt);
    stress_b.advance_with_free_sides(2e-6, dt);
    EXPECT_NEAR(strain_b.state.tensile_strain, strain_a.state.tensile_strain, 1e-5);
    EXPECT_NEAR(stress_b.state.tensile_strain, stress_a.state.tensile_strain, 2e-3 * stress_a.strain[0]);
  }
  EXPECT_GT(strain_b.state.tensile_damage, 0.3);
  EXPECT_GT(stress_b.state.tensile_damage, 0.3);
}

/// Sheared by 4 % under 100 MPa (all principal stresses press), released, then pulled in uniaxial strain.
struct ShearedPoint {
  SinglePoint<Afc> point;
  explicit ShearedPoint(const Afc& afc) : point(afc) {
    const double mu = 0.0118; // 100 MPa
    for (int i = 0; i < 100; ++i) point.advance({-mu / 300, -mu / 300, -mu / 300, 0, 0, 0}, 1e-3);
    for (int i = 0; i < 1000; ++i) point.advance({0, 0, 0, 2e-5, 0, 0}, 1e-3);
    Sym3 back{};
    const double p = -trace(point.stress) / 3, K = afc.hydrostat.unloading_modulus(mu);
    for (int i = 0; i < 3; ++i) back[i] = 0.99 * p / K / 300;
    back[3] = -point.stress[3] / (2 * afc.G) / 100;
    for (int i = 0; i < 100; ++i) point.advance(back, 1e-3);
  }
  void pull(double strain) {
    for (int i = 0; i < 1000; ++i) point.advance({strain / 1000, 0, 0, 0, 0, 0}, dt);
  }
};

TEST(DamageStrain, ShearUnderPressureIsNoCrack) {
  const std::vector<std::string> intact = {"AFC/Shear damage=no"};
  const Afc a = cracking({total, intact[0]}), b = cracking({tensile, intact[0]});
  ShearedPoint whole(a), tension_only(b);
  for (const ShearedPoint* sheared : {&whole, &tension_only}) {
    EXPECT_EQ(sheared->point.state.tensile_damage, 0);
    EXPECT_NEAR(equivalent_stress(sheared->point.stress) / MPa, 0, 3);
    EXPECT_NEAR(trace(sheared->point.stress) / 3 / MPa, -1, 0.1);
  }
  // Tension up to half the threshold (after the release of the pressure) breaks the first point and does not
  // damage the second.
  const double threshold = 2.47 * MPa / cracking_cell(b, cell, 2.47 * MPa, 80).oedometric_modulus();
  const double last = 1 * MPa / b.hydrostat.unloading_modulus(0.0118);
  whole.pull(last + threshold / 2);
  tension_only.pull(last + threshold / 2);
  EXPECT_GT(whole.point.state.tensile_damage, 0.9);
  EXPECT_EQ(tension_only.point.state.tensile_damage, 0);
  // The second point can still dissipate its whole fracture energy.
  const double before = tension_only.point.work;
  for (int i = 0; i < 20; ++i) tension_only.pull(3e-4);
  EXPECT_NEAR(tension_only.point.state.tensile_damage, 1, 1e-6);
  EXPECT_NEAR((tension_only.point.work - before) * cell, 80, 0.04 * 80);
}

TEST(DamageStrain, OpeningAgainToTheSameWidthAddsNothing) {
  const Afc afc = cracking({tensile});
  SinglePoint point(afc);
  const auto pull = [&](double strain) {
    for (int i = 0; i < 500; ++i) point.advance({strain / 500, 0, 0, 0, 0, 0}, dt);
  };
  pull(1e-3);
  const double damage = point.state.tensile_damage;
  for (int cycle = 0; cycle < 5; ++cycle) pull(-8e-4), pull(8e-4);
  EXPECT_NEAR(point.state.tensile_damage, damage, 1e-9);
}

TEST(DamageStrain, WithoutWeightPureShearCountsInFull) {
  for (const std::string& reading : {total, tensile}) {
    const Afc afc = cracking({reading, "AFC/Damage weight=none"});
    SinglePoint point(afc);
    point.advance({0, 0, 0, 1e-3, 0, 0}, 1);
    EXPECT_NEAR(point.state.tensile_strain, 1e-3, 1e-9);
  }
}

} // namespace
} // namespace spall::test
