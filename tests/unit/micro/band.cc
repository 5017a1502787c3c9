#include "micro/ensemble/band.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

using namespace spall;

constexpr double modulus = 30e9;

/// Makes the curve of a brittle bar of a given strength with a straight softening branch to zero at strain
/// 1e-3.
DamageCurve bar(double strength) {
  DamageCurve c;
  c.cell_size = 0.01;
  const double peak = strength / modulus;
  for (int i = 0; i <= 400; ++i) {
    const double strain = i <= 200 ? peak * i / 200 : peak + (1e-3 - peak) * (i - 200) / 200;
    c.strain.push_back(strain);
    c.stress.push_back(i <= 200 ? modulus * strain : strength * (1e-3 - strain) / (1e-3 - peak));
  }
  for (const DamageColumn& column : damage_columns)
    if ((c.*column.values).empty()) (c.*column.values).assign(c.strain.size(), 0);
  for (std::size_t i = 0; i < c.strain.size(); ++i)
    c.psi_undamaged[i] = c.psi_undamaged_plus[i] = 0.5 * modulus * c.strain[i] * c.strain[i];
  return c;
}

TEST(Band, OfEqualCurvesIsThatCurve) {
  const DamageCurve one = bar(3e6);
  const Band band = make_band({&one, &one, &one}, modulus, 0.1, 0.005, 1e-4);
  for (const DamageCurve* curve : {&band.mean, &band.weak, &band.strong})
    for (std::size_t i = 1; i < curve->strain.size(); ++i) {
      const double strain = curve->strain[i];
      const double exact = strain < 1e-4 ? modulus * strain : 3e6 * (1e-3 - strain) / 9e-4;
      EXPECT_NEAR(curve->stress[i], exact, 1e-9 * 3e6);
      EXPECT_NEAR(curve->damage[i], 1 - exact / (modulus * strain), 1e-9);
    }
}

TEST(Band, QuantilesEncloseTheMeanAndEveryTableIsValid) {
  std::vector<DamageCurve> curves;
  for (int i = 0; i < 21; ++i) curves.push_back(bar(2e6 + 1e5 * i));
  std::vector<const DamageCurve*> all;
  for (const DamageCurve& curve : curves) all.push_back(&curve);
  Band band = make_band(all, modulus, 0.1, 0.02, 1e-4);
  ASSERT_EQ(band.mean.strain, band.weak.strain);
  EXPECT_NEAR(band.mean.strain.back(), 1e-3, 1e-15);
  // The quantiles are the order statistics 2 and 18 of 0..20 in the softening range, where stresses are
  // ordered like strengths.
  const auto i = static_cast<std::size_t>(
      std::lower_bound(band.mean.strain.begin(), band.mean.strain.end(), 5e-4) - band.mean.strain.begin());
  const auto exact = [&](double strength) {
    return strength * (1e-3 - band.mean.strain[i]) / (1e-3 - strength / modulus);
  };
  EXPECT_NEAR(band.weak.stress[i], exact(2.2e6), 1e-6 * 3e6);
  EXPECT_NEAR(band.strong.stress[i], exact(3.8e6), 1e-6 * 3e6);
  // The peaks, by which the strength damage is normalised, are stored as factors. The mean of triangular
  // curves with different peaks is lower than the mean peak.
  const auto peak = [](const DamageCurve& c) { return *std::max_element(c.stress.begin(), c.stress.end()); };
  EXPECT_EQ(band.mean.relative_strength, 1);
  EXPECT_LT(band.weak.relative_strength, 0.85);
  EXPECT_GT(band.strong.relative_strength, 1.15);
  for (const DamageCurve* curve : {&band.weak, &band.strong})
    EXPECT_NEAR(curve->relative_strength * peak(band.mean), peak(*curve), 1e-9 * peak(*curve));
  for (std::size_t k = 1; k < band.mean.strain.size(); ++k)
    EXPECT_LE(band.weak.stress[k], band.strong.stress[k]);
  DamageTable table;
  table.youngs_modulus = modulus;
  table.poisson_ratio = 0.2;
  table.tensile_strength = 3e6;
  table.fracture_energy = 50;
  for (const DamageCurve* curve : {&band.mean, &band.weak, &band.strong}) {
    table.curves = {*curve};
    EXPECT_NO_THROW(check(table, "band"));
  }
}

} // namespace
