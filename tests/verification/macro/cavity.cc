// Tests of the solver against the one-dimensional solution of a cavity that opens in concrete: the confined
// flow in front of a projectile.

#include "tests/verification/macro/cavity_cases.h"

#include <gtest/gtest.h>

namespace spall::test {
namespace {

TEST(CavityInOneDimension, HalvingTheCellsChangesThePressureByLessThanHalfAPercent) {
  for (const int hoops : {1, 2}) {
    const Cavity cavity = CavityCase{.hoops = hoops}.cavity();
    const Afc law = make(Concrete::cracking);
    const CavityResult coarse = open_in_one_dimension(law, cavity),
                       fine = open_in_one_dimension(law, cavity, RadialMesh{}.halved());
    std::printf("wall %.1f and %.1f MPa\n", coarse.wall.late_mean(0) / MPa, fine.wall.late_mean(0) / MPa);
    EXPECT_NEAR(coarse.wall.late_mean(0), fine.wall.late_mean(0), 0.005 * fine.wall.late_mean(0));
    for (std::size_t k = 0; k < cavity.gauges.size(); ++k)
      EXPECT_NEAR(coarse.gauges.late_mean(k), fine.gauges.late_mean(k), -0.005 * fine.gauges.late_mean(k));
  }
}

TEST(CavityInOneDimension, HasThePressureOfAnIndependentProgram) {
  // A finite-volume program with its own law: mean of the last 40 % of the time, without damage.
  const double known[] = {494.6 * MPa, 589.4 * MPa};
  Afc law = make(Concrete::cracking);
  law.volumetric_strain = VolumetricStrain::density_ratio;
  for (const int hoops : {1, 2}) {
    const Cavity cavity{.hoops = hoops, .radius = 6e-3, .opened = 13e-3, .ramp = 4e-6, .outer_radius = 0.6};
    const CavityResult result = open_in_one_dimension(law, cavity);
    EXPECT_NEAR(result.wall.late_mean(0, 0.6), known[hoops - 1], 0.005 * known[hoops - 1]);
  }
}

TEST(CavityPoints, FillTheBody) {
  for (const int hoops : {1, 2}) {
    const CavityCase c{.hoops = hoops};
    const double inner = c.cavity().radius, outer = shells_around(c.cavity(), c.grading()).boundary.back();
    const double exact = hoops == 1 ? std::numbers::pi * CavityBody::height * (outer * outer - inner * inner)
                                    : 4. / 3 * std::numbers::pi * (std::pow(outer, 3) - std::pow(inner, 3));
    EXPECT_NEAR(c.body().volume(), exact, 1e-9 * exact);
  }
}

/// Expects the radial stress of neighbour shells, as their mean and as their difference, within 3 %, and the
/// zones within a spacing. Hoop tension cracks the concrete as far as the front of the elastic wave, which is
/// several coarse spacings wide: two of them.
void expect_agreement(const CavityCase& c) {
  const CavityDeviation d = deviation(c);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_NEAR(d.stress[k], 0, 0.03) << "gauge " << k;
    EXPECT_NEAR(d.alternating[k], 0, 0.03) << "gauge " << k;
  }
  EXPECT_NEAR(d.crushed, 0, 1);
  EXPECT_NEAR(d.flowing, 0, c.concrete == Concrete::cracking && c.hoops == 1 ? 2 : 1);
}

class CavityOfPoints : public ::testing::TestWithParam<CavityCase> {};
class FineCavityOfPoints : public CavityOfPoints {};

std::string label(const ::testing::TestParamInfo<CavityCase>& instance) {
  const CavityCase& c = instance.param;
  std::string name = std::string(name_of(c.concrete)) + "_" + name_of(c.scheme) +
                     (c.hoops == 1 ? "_cylinder" : "_sphere") + (c.velocity < 50 ? "_slow" : "") +
                     (c.radius < 12e-3 ? "_small_hole" : "") +
                     (c.least_stretch < SupportInputs{}.min_stretch ? "_flat_supports" : "");
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

TEST_P(CavityOfPoints, HasTheStressesAndZonesOfTheOneDimensionalSolution) { expect_agreement(GetParam()); }
TEST_P(FineCavityOfPoints, HasTheStressesAndZonesOfTheOneDimensionalSolution) {
  expect_agreement(GetParam());
}

constexpr Scheme subpoint = Scheme::subpoint, nsni = Scheme::nsni, m_snni = Scheme::m_snni;
/// The stresses are still small against the moduli.
constexpr double slightly_opened = 13e-3;
/// Supports can still follow the flattening of the cells around a sphere, down to 0.44 of their width.
constexpr double half_opened = 18e-3;

INSTANTIATE_TEST_SUITE_P(
    All, CavityOfPoints,
    ::testing::Values(
        CavityCase{.concrete = Concrete::elastic, .scheme = subpoint, .opened = slightly_opened},
        CavityCase{.concrete = Concrete::elastic, .scheme = nsni, .opened = slightly_opened},
        CavityCase{.concrete = Concrete::elastic, .scheme = m_snni, .opened = slightly_opened},
        CavityCase{.scheme = subpoint}, CavityCase{.scheme = nsni}, CavityCase{.scheme = m_snni},
        CavityCase{.scheme = nsni, .hoops = 2, .spacing = 2e-3, .opened = half_opened}),
    label);

INSTANTIATE_TEST_SUITE_P(
    All, FineCavityOfPoints,
    ::testing::Values(CavityCase{.concrete = Concrete::frictional, .scheme = subpoint, .spacing = 2e-3},
                      CavityCase{.concrete = Concrete::frictional, .scheme = m_snni, .spacing = 2e-3},
                      CavityCase{.concrete = Concrete::compacting, .scheme = subpoint, .spacing = 2e-3},
                      CavityCase{.concrete = Concrete::compacting, .scheme = nsni, .spacing = 2e-3},
                      CavityCase{.concrete = Concrete::compacting, .scheme = m_snni, .spacing = 2e-3},
                      CavityCase{.scheme = subpoint, .spacing = 2e-3},
                      CavityCase{.scheme = nsni, .spacing = 2e-3},
                      CavityCase{.scheme = m_snni, .spacing = 2e-3},
                      CavityCase{.scheme = subpoint, .spacing = 2e-3, .velocity = 25},
                      CavityCase{.scheme = subpoint, .hoops = 2, .spacing = 2e-3, .opened = half_opened},
                      CavityCase{.scheme = m_snni, .hoops = 2, .spacing = 2e-3, .opened = half_opened}),
    label);

/// A hole that opens to six times its radius flattens the cells around it to 0.16 of their width, as in front
/// of a projectile. Where the supports do not follow so far they overlap many shells, and the points lose
/// their confinement: the radial stress is 26 % too small with sub-points, 13 % with NSNI and 15 % with
/// M-SNNI with a smallest stretch of 0.5, and 0, 2 and 0 % with 0.2.
class SmallHole : public CavityOfPoints {};
TEST_P(SmallHole, HasTheStressesOfTheOneDimensionalSolution) {
  const CavityDeviation d = deviation(GetParam());
  for (const double error : d.stress) EXPECT_NEAR(error, 0, 0.03);
}
CavityCase small_hole(Scheme scheme, double least_stretch) {
  return {.concrete = Concrete::compacting,
          .scheme = scheme,
          .spacing = 2e-3,
          .radius = 4e-3,
          .least_stretch = least_stretch};
}
INSTANTIATE_TEST_SUITE_P(All, SmallHole,
                         ::testing::Values(small_hole(subpoint, 0.2), small_hole(m_snni, 0.2)), label);

class CavityRefreshed : public ::testing::TestWithParam<Scheme> {};
TEST_P(CavityRefreshed, DoesNotDependOnTheInterval) {
  // NSNI depends on it: by 3.3 % between refreshes every step and every 5 steps.
  const double tolerance = GetParam() == nsni ? 0.04 : 0.01;
  const auto opened = [](int interval) { return CavityCase{.scheme = GetParam()}.body().run(interval); };
  const CavityResult known = opened(1);
  for (const int interval : {2, 5}) {
    const CavityResult found = opened(interval);
    for (std::size_t k = 0; k < 2; ++k) {
      const double change = stress_at_gauge(found, k).mean / stress_at_gauge(known, k).mean - 1;
      std::printf("%s, gauge %zu: %+.2f %% with a refresh every %d steps\n", name_of(GetParam()), k,
                  100 * change, interval);
      EXPECT_NEAR(change, 0, tolerance);
    }
  }
}
INSTANTIATE_TEST_SUITE_P(All, CavityRefreshed, ::testing::Values(subpoint, nsni, m_snni),
                         [](const auto& instance) {
                           std::string name = name_of(instance.param);
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

} // namespace
} // namespace spall::test
