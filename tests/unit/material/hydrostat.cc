#include "tests/unit/material/samples.h"

#include <gtest/gtest.h>

namespace spall::test {
namespace {

/// Returns the pressure after compressing a point to mu in equal steps.
double pressure_at(SinglePoint<Afc>& point, double mu, int steps = 1) {
  const double each = (-mu - trace(point.strain)) / 3 / steps;
  for (int i = 0; i < steps; ++i) point.advance({each, each, each, 0, 0, 0}, 1e-3);
  return -trace(point.stress) / 3;
}

TEST(Hydrostat, FirstLoadingHasTheValuesOfTheTableAtAnyStepSize) {
  const Afc afc = wes5000();
  const double mus[] = {0.005, 0.01, 0.05, 0.1, 0.25};
  const double pressures[] = {65.8, 87.4, 278.2, 591.5, 2520.7}; // MPa, by hand from Table 1
  for (int i = 0; i < 5; ++i)
    for (const int steps : {1, 1000}) {
      SinglePoint point(afc);
      EXPECT_NEAR(pressure_at(point, mus[i], steps) / MPa, pressures[i], 0.06);
      EXPECT_NEAR(equivalent_stress(deviator(point.stress)), 0, 1);
    }
  SinglePoint point(afc);
  EXPECT_NEAR(pressure_at(point, 0.0025) / MPa, 55.14, 1e-9);
  EXPECT_NEAR(pressure_at(point, 0.35) / MPa, 2520.70 + 68237 * 0.1, 0.01);
}

TEST(Hydrostat, ShiftedReadingIsContinuousAndThePrintedOneDrops) {
  Hydrostat h = wes5000().hydrostat;
  EXPECT_NEAR(h.curve(h.C7 * (1 + 1e-12)), h.C6, 1e-6 * h.C6);
  h.form = HydrostatForm::printed;
  EXPECT_NEAR(h.curve(h.C7 * (1 + 1e-12)) / MPa, 10.66, 0.005); // C7 K1 + C7^2 K2 + C7^3 K3
}

TEST(Hydrostat, UnloadsAndReloadsAlongOneLineOfTheInterpolatedModulus) {
  const Afc afc = wes5000();
  const double K = 55.14 / 0.0025, fractions[] = {0, 0.5, 1};
  for (const double fraction : fractions) {
    const double largest = 0.0025 + fraction * (0.25 - 0.0025) + 1e-9;
    SinglePoint point(afc);
    const double top = pressure_at(point, largest, 50);
    const double expected = (K + fraction * (68237 - K)) * MPa;
    const double d = 1e-4;
    EXPECT_NEAR((top - pressure_at(point, largest - d, 3)) / d, expected, 1e-5 * expected);
    EXPECT_NEAR(pressure_at(point, largest, 7), top, 1e-9 * top);
  }
}

TEST(Hydrostat, PartOfTheWidestOpeningStays) {
  const double limit = 2.47 * MPa;
  for (const double kept : {0., 0.1, 0.5, 1.}) {
    const Afc afc = wes5000({"AFC/Opened volume kept=" + std::to_string(kept)});
    const double K = afc.bulk_modulus();
    SinglePoint point(afc);
    for (const double widest : {1e-3, 2e-3}) {
      EXPECT_NEAR(pressure_at(point, -widest - limit / K, 20), -limit, 1);
      // Closing and opening again up to there: the secant to where the faces meet, before mu = 0, and from
      // there on the line of the sound material.
      const double secant = limit / (widest + limit / K - kept * widest);
      for (const double share : {0.8, 0.1, 0.5, 0., 1., -0.1})
        EXPECT_NEAR(pressure_at(point, -share * widest, 7),
                    (share > kept ? secant : K) * (kept - share) * widest, 1)
            << kept << " at " << share;
    }
  }
}

TEST(Hydrostat, OpenCrackThatSlipsTouchesAgainAtTheDilatancyTimesItsSlip) {
  const double strain = 4e-3, dilatancy = 1.4;
  const Afc afc = wes5000({"AFC/Crack dilatancy=1.4"});
  const double K = afc.bulk_modulus(), opening = strain - 2.47 * MPa / K;
  const Mat3 turn = rotation();
  for (const double slip : {0., 1e-3, 2e-3, 8e-3}) {
    SinglePoint point(afc);
    // The crack opens along one direction, which is no slip except in the step that reaches the strength,
    // then it slips.
    for (int i = 0; i < 1000; ++i) point.advance(rotate(turn, {0, 0, strain / 1000, 0, 0, 0}), 1e-6);
    EXPECT_NEAR(point.state.opened, 0, 0.1 * opening);
    const double before = point.state.opened;
    for (int i = 0; i < 1000; ++i) point.advance(rotate(turn, {0, 0, 0, 0, slip / 2000, 0}), 1e-6);
    const double touching = std::min(opening, before + dilatancy * slip);
    EXPECT_NEAR(point.state.opened, touching, 1e-9) << slip;
    // Closing adds no slip, and pressure begins where the faces touch.
    EXPECT_NEAR(pressure_at(point, 1e-3 - touching, 50), K * 1e-3, 1e-6 * K) << slip;
  }
}

TEST(Hydrostat, TensionIsCutOffAndTheOpenedPointClosesAlongTheSecant) {
  const Afc afc = wes5000();
  SinglePoint point(afc);
  EXPECT_NEAR(pressure_at(point, -1e-4), -afc.bulk_modulus() * 1e-4, 1);
  EXPECT_DOUBLE_EQ(pressure_at(point, -1e-3), -2.47 * MPa);
  EXPECT_DOUBLE_EQ(pressure_at(point, -0.5), -2.47 * MPa);
  EXPECT_NEAR(pressure_at(point, -0.2), -2.47 * MPa * 0.4, 1);
  EXPECT_NEAR(pressure_at(point, 0.002), afc.bulk_modulus() * 0.002, 1);
}

TEST(Hydrostat, CutOffClosesAlongTheLineOnWhichItOpened) {
  const Afc afc = wes5000({"AFC/Opening=cut-off"});
  SinglePoint point(afc);
  EXPECT_DOUBLE_EQ(pressure_at(point, -5e-3, 1000), -2.47 * MPa);
  EXPECT_DOUBLE_EQ(pressure_at(point, -2e-3, 1000), -2.47 * MPa);
  EXPECT_NEAR(pressure_at(point, -1e-4, 1000), -afc.bulk_modulus() * 1e-4, 1);
  EXPECT_NEAR(pressure_at(point, 0.002, 1000), afc.bulk_modulus() * 0.002, 1);
  // What opening has cost has come back: the work left is what pressing has stored.
  EXPECT_NEAR(point.work, afc.bulk_modulus() * 0.002 * 0.002 / 2, 1e-3 * point.work);
}

// A cracked point drops its deviator where it opens; with a cut-off it keeps it as far as the strength goes.
TEST(Hydrostat, CutOffKeepsTheShearStiffnessOfAnOpenPoint) {
  const double strain = 1e-5;
  for (const char* opening : {"cut-off", "cracks"}) {
    const Afc afc = wes5000({std::string("AFC/Opening=") + opening});
    SinglePoint point(afc);
    pressure_at(point, -1e-5); // in tension, below the limit
    point.advance({strain, -strain, 0, 0, 0, 0}, 1e-3);
    EXPECT_NEAR(point.stress[0] - point.stress[1], 4 * afc.G * strain, 1);
    pressure_at(point, -1e-2, 100); // at the limit nothing is left of the strength
    EXPECT_NEAR(equivalent_stress(deviator(point.stress)), 0, 1);
    pressure_at(point, -5e-5);
    point.advance({0, 0, 0, strain, 0, 0}, 1e-3);
    const double sound = 2 * afc.G * strain;
    EXPECT_NEAR(point.stress[3], opening == std::string("cut-off") ? sound : 0, 1e-3 * sound);
  }
}

TEST(Hydrostat, TangentIsTheDerivativeOfThePressure) {
  for (const char* reading : {"AFC/Volumetric strain=logarithmic", "AFC/Volumetric strain=density ratio"}) {
    const Afc afc = wes5000({reading});
    for (const double largest : {0.001, 0.1, 0.3})
      for (const double back : {0., 1e-4}) {
        SinglePoint point(afc);
        pressure_at(point, largest);
        pressure_at(point, largest - back);
        const double d = back > 0 ? -1e-7 : 1e-7;
        const Stiffness tangent = point.advance({-d / 3, -d / 3, -d / 3, 0, 0, 0}, 1e-3);
        const double p = -trace(point.stress) / 3;
        const double slope = (pressure_at(point, -trace(point.strain) + d) - p) / d;
        EXPECT_NEAR(tangent.bulk, slope, 1e-4 * slope);
      }
    SinglePoint open(afc);
    EXPECT_EQ(open.advance({1e-3, 1e-3, 1e-3, 0, 0, 0}, 1e-3).bulk, 0);
  }
}

TEST(Hydrostat, DensityRatioReadingUsesOneOverJ) {
  const Afc afc = wes5000({"AFC/Volumetric strain=density ratio"});
  SinglePoint point(afc);
  EXPECT_NEAR(pressure_at(point, 0.1), afc.hydrostat.curve(std::exp(0.1) - 1), 1);
}

TEST(Hydrostat, ResidualVolumeIsWhereUnloadingMeetsZero) {
  const Afc afc = wes5000();
  SinglePoint point(afc);
  pressure_at(point, 0.1);
  EXPECT_NEAR(pressure_at(point, afc.hydrostat.plastic_strain(0.1)), 0, 10);
  EXPECT_EQ(afc.hydrostat.plastic_strain(0.0025), 0);
}

TEST(Hydrostat, SoundSpeedGrowsFromTheIntactToTheLockedModulus) {
  const Afc afc = wes5000();
  EXPECT_NEAR(afc.sound_speed({}), 3713, 1); // sqrt((22056 + 4/3 6892.7) MPa / 2267)
  Afc::State locked;
  locked.largest_compression = 0.4;
  EXPECT_NEAR(afc.sound_speed(locked), std::sqrt((68237 + 4. / 3 * 6892.7) * MPa / 2267), 1e-6);
}

TEST(Hydrostat, ElasticUnloadingKeepsTheFirstModulusUntilLocking) {
  const Hydrostat h = wes5000({"AFC/Unloading=elastic"}).hydrostat;
  for (const double largest : {0.002, 0.05, 0.2})
    EXPECT_EQ(h.unloading_modulus(largest), h.elastic_modulus());
  EXPECT_EQ(h.unloading_modulus(0.25), h.C8);
}

} // namespace
} // namespace spall::test
