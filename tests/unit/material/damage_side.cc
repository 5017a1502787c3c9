#include "tests/unit/material/samples.h"

#include <gtest/gtest.h>

namespace spall::test {
namespace {

constexpr double cohesion = 501.05 - 476.3;                             // MPa
double decay(double pressure) { return std::exp(-0.00324 * pressure); } // MPa
double intact(double pressure) { return 501.05 - 476.3 * decay(pressure) + 0.1 * pressure; }

/// Equivalent stress (MPa) of a damaged point sheared far beyond its strength at a pressure (MPa).
double sheared(const std::vector<std::string>& changes, double shear_damage, double tensile_damage,
               double pressure) {
  std::vector<std::string> all = {"AFC/C3=0"};
  all.insert(all.end(), changes.begin(), changes.end());
  const Afc afc = wes5000(all);
  SinglePoint point(afc);
  point.state.shear_damage = shear_damage;
  point.state.tensile_damage = tensile_damage;
  const double e = -pressure * MPa / afc.bulk_modulus() / 3;
  point.advance({e, e, e, 0.1, 0, 0}, 1);
  EXPECT_NEAR(-trace(point.stress) / 3, pressure * MPa, 1);
  return equivalent_stress(deviator(point.stress)) / MPa;
}

TEST(DamageSide, AsPrintedShearActsOnBothSidesAndTensileDamageInTensionAlone) {
  const double d = 0.3, dt = 0.6;
  EXPECT_NEAR(sheared({}, d, dt, 40), intact(40) - cohesion * d * decay(40), 1e-6);
  EXPECT_NEAR(sheared({}, d, dt, -0.5), cohesion * (1 - d) * (1 - 0.5 / (2.47 * (1 - dt))), 1e-6);
  EXPECT_NEAR(sheared({}, 0, 1, 40), intact(40), 1e-6); // cracked, all cohesion is back
}

TEST(DamageSide, ShearDamageMayLeaveTensionAlone) {
  const std::vector<std::string> reading = {"AFC/Shear damage acts in=compression"};
  EXPECT_NEAR(sheared(reading, 1, 0, 40), intact(40) - cohesion * decay(40), 1e-6);
  EXPECT_NEAR(sheared(reading, 1, 0, -0.5), cohesion * (1 - 0.5 / 2.47), 1e-6);
  EXPECT_NEAR(sheared(reading, 1, 0.6, -0.5), cohesion * (1 - 0.5 / (2.47 * 0.4)), 1e-6);
}

TEST(DamageSide, TensileDamageMayTakeTheCohesionUnderPressureToo) {
  const std::vector<std::string> reading = {"AFC/Tensile damage acts in=compression and tension"};
  const double d = 0.3, dt = 0.6, lost = 1 - (1 - d) * (1 - dt);
  EXPECT_NEAR(sheared(reading, d, dt, 40), intact(40) - cohesion * lost * decay(40), 1e-6);
  EXPECT_NEAR(sheared(reading, d, dt, -0.5), cohesion * (1 - lost) * (1 - 0.5 / (2.47 * (1 - dt))), 1e-6);
  EXPECT_NEAR(sheared(reading, d, dt, -1e-6), sheared(reading, d, dt, 1e-6), 1e-4); // both surfaces meet
  // Rubble: friction alone.
  EXPECT_NEAR(sheared(reading, 0, 1, 40), 501.05 * (1 - decay(40)) + 4, 1e-6);
}

} // namespace
} // namespace spall::test
