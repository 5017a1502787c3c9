#include "tests/unit/material/samples.h"

#include <gtest/gtest.h>

namespace spall::test {
namespace {

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

TEST(Energy, OpeningDissipatesWhatTheSecantDoesNotGiveBack) {
  const Afc afc = wes5000();
  SinglePoint point(afc);
  for (const double step : {1e-6, -1e-6})
    for (int i = 0; i < 1000; ++i) point.advance({step, step, step, 0, 0, 0}, 1e-6);
  const double limit = 2.47 * MPa, volume = 3e-3;
  EXPECT_NEAR(point.work, limit * (volume - limit / afc.bulk_modulus()) / 2, 1);
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
