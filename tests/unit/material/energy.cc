#include "tests/unit/material/cracking_cell.h"

#include <gtest/gtest.h>

namespace spall::test {
namespace {

/// Returns the recoverable energy of the concrete, J/m^3: that of the deviator, and that of the volume along
/// its unloading line and along the tension cut-off (an opened point closes along it, except for the part
/// that stays open).
double elastic_energy(const Afc& afc, const SinglePoint<Afc>& point) {
  const Sym3 s = deviator(point.stress);
  const auto [uncut, unused] =
      afc.hydrostat(point.state.opened - trace(point.strain), point.state.largest_compression);
  const double K = afc.hydrostat.unloading_modulus(point.state.largest_compression);
  const double T = afc.tensile.limit(point.state.tensile_damage, point.state.tensile_rate_factor);
  const double p = std::max(uncut, -T);
  return contract(s, s) / (4 * afc.G) + p * p / (2 * K) + T * (p - uncut) / K;
}

TEST(Energy, ClosedElasticCycleDissipatesNothing) {
  const Afc afc = wes5000();
  SinglePoint point(afc);
  RandomStrain strain(5e-6);
  double largest = 0;
  for (int i = 0; i < 200; ++i) {
    point.advance(strain(), 1e-6);
    largest = std::max(largest, point.work);
  }
  ASSERT_EQ(point.state.plastic_strain, 0);
  Sym3 back;
  for (int i = 0; i < 6; ++i) back[i] = -point.strain[i];
  point.advance(back, 1e-6);
  EXPECT_GT(largest, 1);
  EXPECT_NEAR(point.work, 0, 1e-9 * largest);
  EXPECT_SAME_STRESS(point.stress, Sym3{}, 1e-3);
}

TEST(Energy, OpeningAndClosingWithoutDamageDissipatesNothing) {
  const Afc afc = wes5000();
  SinglePoint point(afc);
  for (const double step : {1e-6, -1e-6})
    for (int i = 0; i < 1000; ++i) point.advance({step, step, step, 0, 0, 0}, 1e-6);
  EXPECT_NEAR(point.work, 0, 1); // 7000 J/m^3 of work were done on the way
}

/// Alternatives and constants that change the energy of a path.
class EnergyOf : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Readings, EnergyOf,
                         ::testing::Values("AFC/Damage strain=tensile", "AFC/Damage strain=total",
                                           "AFC/Tensile rate law=Malvar Crawford", "AFC/Opened volume kept=1",
                                           "AFC/Crack dilatancy=1.4", "AFC/Opened volume kept=0.3",
                                           "AFC/Lode eccentricity=0.68", "AFC/Unloading=elastic",
                                           "AFC/Shear damage acts in=compression",
                                           "AFC/Tensile damage acts in=compression and tension"));

TEST_P(EnergyOf, DissipationNeverDecreases) {
  for (const bool cracks : {false, true})
    for (const double size : {3e-6, 3e-5}) {
      Afc afc = wes5000({GetParam()});
      if (cracks) afc.tensile.use(cracking_cell(afc, 16e-3, 2.47 * MPa, 80), {16e-3});
      SinglePoint point(afc);
      RandomStrain strain(size);
      double dissipated = 0;
      for (int i = 0; i < 100000; ++i) {
        // A slow oscillation between compression and tension is added to the random walk.
        Sym3 e = strain();
        const double swing = 0.2 * size * std::sin(i * 1e-3);
        e[0] += swing, e[1] += swing;
        point.advance(e, 1e-6);
        const double now = point.work - elastic_energy(afc, point);
        // Trapezoidal work misses at most K (tr e)^2 / 8 where a step crosses the kink at the cut-off.
        const double trace_of_step = 3.4 * size,
                     error = afc.hydrostat.unloading_modulus(point.state.largest_compression) *
                             trace_of_step * trace_of_step / 8;
        ASSERT_GE(now, dissipated - error) << "step " << i;
        dissipated = now;
      }
      EXPECT_GT(dissipated, 0);
      EXPECT_GT(point.state.plastic_strain, 0);
      EXPECT_EQ(point.state.tensile_damage > 0, cracks);
    }
}

TEST(Energy, CrushingDissipatesTheAreaBetweenLoadingAndUnloading) {
  const Afc afc = wes5000();
  SinglePoint point(afc);
  const double residual = afc.hydrostat.plastic_strain(0.1);
  for (int i = 0; i < 10000; ++i) point.advance({-1e-5 / 3, -1e-5 / 3, -1e-5 / 3, 0, 0, 0}, 1);
  const double p = -trace(point.stress) / 3, loading = point.work;
  for (int i = 0; i < 1000; ++i) {
    const double e = (0.1 - residual) / 3000;
    point.advance({e, e, e, 0, 0, 0}, 1);
  }
  // Integral of Eqs. 20 and 21 from 0 to 0.1, less the triangle of unloading.
  const double m = 0.0975;
  const double area = (55.14 * 0.0025 / 2 + 55.14 * m + 4248.3 * m * m / 2 + 6196.5 * m * m * m / 3 +
                       68237 * m * m * m * m / 4) *
                      MPa;
  EXPECT_NEAR(loading, area, 1e-6 * area);
  EXPECT_NEAR(point.work, area - p * (0.1 - residual) / 2, 1e-6 * area);
}

} // namespace
} // namespace spall::test
