#include "tests/unit/material/samples.h"

#include <gtest/gtest.h>

namespace spall::test {
namespace {

TEST(ShearDamage, GrowsByPlasticStrainOverFailureStrainAtHeldPressure) {
  const Afc afc = wes5000();
  const double D1 = 0.0006;                // 1/MPa
  for (const double mu : {0.002, 0.005}) { // 44 MPa: D1 P = 0.026; 66 MPa: 0.039
    SinglePoint point(afc);
    point.advance({-mu / 3, -mu / 3, -mu / 3, 0, 0, 0}, 1);
    const double start = point.state.shear_damage;
    const double pressure = -trace(point.stress) / 3 / MPa;
    for (int step = 0; step < 100; ++step) point.advance({0, 0, 0, 1e-4, 0, 0}, 1e-3);
    EXPECT_GT(point.state.plastic_strain, 1e-3);
    EXPECT_NEAR(point.state.shear_damage - start, point.state.plastic_strain / (D1 * pressure), 1e-12);
  }
}

TEST(ShearDamage, CrushingAddsTheResidualVolumeOverOneAndAHalfLockingVolumes) {
  // Beyond locking the point unloads along the locking line, which meets P = 0 at C9 - P(C9) / C8 (Eq. 21).
  const double m = 0.25 - 0.0025, locking = 55.14 + 4248.3 * m + 6196.5 * m * m + 68237 * m * m * m; // MPa
  const double expected = (0.25 - locking / 68237) / (1.5 * 0.25);
  EXPECT_NEAR(expected, 0.5682, 5e-5);
  const Afc afc = wes5000();
  SinglePoint point(afc);
  for (int step = 0; step < 10; ++step) point.advance({-0.01, -0.01, -0.01, 0, 0, 0}, 1); // to mu = 0.3
  EXPECT_NEAR(point.state.shear_damage, expected, 1e-12);
  EXPECT_EQ(point.state.plastic_strain, 0);
  point.advance({0.1, 0.1, 0.1, 0, 0, 0}, 1); // no healing
  EXPECT_NEAR(point.state.shear_damage, expected, 1e-12);
}

TEST(ShearDamage, FloorActsAtLowPressureAndAsPrintedTheFirstPlasticStepFails) {
  const Sym3 shear = {0, 0, 0, 2e-3, 0, 0}; // P = 0, beyond the strength of 24.75 MPa at once
  const Afc floored = wes5000(), printed = wes5000({"AFC/Failure strain floor=0"});
  SinglePoint a(floored), b(printed);
  a.advance(shear, 1e-3);
  b.advance(shear, 1e-3);
  EXPECT_GT(a.state.plastic_strain, 1e-5);
  EXPECT_NEAR(a.state.shear_damage, a.state.plastic_strain / 0.01, 1e-12);
  EXPECT_EQ(b.state.shear_damage, 1);
  b.advance(shear, 1e-3);
  EXPECT_NEAR(equivalent_stress(deviator(b.stress)), 0, 1e-3); // no cohesion left
}

TEST(ShearDamage, NeverExceedsOneAndCanBeSwitchedOff) {
  const Afc on = wes5000(), off = wes5000({"AFC/Shear damage=no"});
  SinglePoint a(on), b(off);
  for (int step = 0; step < 100; ++step) {
    a.advance({-1e-3, -1e-3, 0, 1e-2, 0, 0}, 1e-3);
    b.advance({-1e-3, -1e-3, 0, 1e-2, 0, 0}, 1e-3);
  }
  EXPECT_EQ(a.state.shear_damage, 1);
  EXPECT_EQ(b.state.shear_damage, 0);
  EXPECT_GT(b.state.plastic_strain, 0.5);
}

/// Returns the work to destroy a point by uniaxial compression, per area of a band one spacing wide, N/m.
double crushing_work(double spacing, const std::string& reference) {
  const Afc afc = wes5000({"AFC/Shear damage reference length=" + reference});
  SinglePoint point(afc, spacing);
  while (point.state.shear_damage < 1) point.advance_with_free_sides(-2e-5, 0.02);
  return point.work * spacing;
}

TEST(ShearDamage, WorkPerAreaOfABandDoesNotDependOnTheSpacing) {
  const double expected = crushing_work(10e-3, "10 mm");
  EXPECT_GT(expected, 1e3);
  for (const double spacing : {5e-3, 8e-3, 15e-3, 20e-3})
    EXPECT_NEAR(crushing_work(spacing, "10 mm"), expected, 0.02 * expected) << spacing;
  // Without the reference length the work per volume is the same at any spacing.
  EXPECT_NEAR(crushing_work(10e-3, "0 m"), expected, 1e-9 * expected);
  EXPECT_NEAR(crushing_work(20e-3, "0 m"), 2 * expected, 1e-9 * expected);
}

TEST(ShearDamage, StabilisingShearStiffnessKeepsTheShareOfTheStrength) {
  const Afc afc = wes5000();
  Sym3 stress{};
  Afc::State broken;
  broken.shear_damage = 1;
  const Sym3 none{};
  // At zero pressure no stiffness is left; under 50 MPa that of friction is.
  EXPECT_EQ(afc.update(stress, broken, {none, 1e-3, 1, identity3}).shear, 0);
  const double mu = 50 * MPa / afc.bulk_modulus();
  const double share = afc.update(stress, broken, {none, 1e-3, std::exp(-mu), identity3}).shear / afc.G;
  EXPECT_NEAR(share, (501.05 - 501.05 * std::exp(-0.00324 * 50) + 5) / 100.98, 1e-4);
}

} // namespace
} // namespace spall::test
