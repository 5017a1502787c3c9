// The concrete of Riedel, Hiermaier and Thoma at a point against its own equations. The numbers are those of
// concrete_35_rht.prm, written down a second time.

#include "shared/error.h"
#include "tests/unit/material/cracking_cell.h"

#include <gtest/gtest.h>

namespace spall::test::of_rht {
namespace {

constexpr double GPa = 1e9, dt = 1e-6, fc = 35e6, alpha0 = 1.1884;

Rht rht(std::vector<std::string> changes = {}) {
  for (std::string& change : changes) change = "RHT/" + change;
  Material made = material("concrete_35_rht", changes);
  prepare(made, {8e-3});
  return std::get<Rht>(made);
}

double solid(double x) { return (35.27 * x + 39.58 * x * x + 9.04 * x * x * x) * GPa; }
double collapse(double alpha) { return (6000 - (6000 - 23.3) * std::cbrt((alpha - 1) / (alpha0 - 1))) * MPa; }
/// P of first loading: by bisection for alpha.
double first_loading(double mu) {
  const auto P = [&](double alpha) { return solid(alpha * (1 + mu) / alpha0 - 1) / alpha; };
  if (P(alpha0) <= 23.3 * MPa) return P(alpha0);
  if (P(1) >= 6 * GPa) return P(1);
  double low = 1, high = alpha0;
  for (int i = 0; i < 200; ++i) {
    const double middle = (low + high) / 2;
    (P(middle) < collapse(middle) ? low : high) = middle;
  }
  return P(low);
}

/// Changes the volume of a point evenly until mu = density over initial density - 1 is this.
void press_to(SinglePoint<Rht>& point, double mu, int steps = 2000) {
  const double e = (-std::log1p(mu) - trace(point.strain)) / 3 / steps;
  for (int i = 0; i < steps; ++i) point.advance({e, e, e, 0, 0, 0}, dt);
}
double pressure(const SinglePoint<Rht>& point) { return -trace(point.stress) / 3; }
void shear(SinglePoint<Rht>& point, int steps, double rate = 1) {
  const double e = 2e-5;
  for (int i = 0; i < steps; ++i) point.advance({0, 0, 0, e, 0, 0}, 2 / std::sqrt(3.) * e / rate);
}

TEST(Rht, PressureIsElasticCollapsingAndSolid) {
  const Rht m = rht();
  SinglePoint point(m);
  for (const double mu : {1e-4, 7e-4, 9e-4, 0.01, 0.05, 0.15, 0.25, 0.33, 0.4}) {
    press_to(point, mu);
    EXPECT_NEAR(pressure(point), first_loading(mu), 1e-6 * first_loading(mu)) << mu;
  }
  EXPECT_NEAR(m.alpha(point.state), 1, 1e-12);
}

TEST(Rht, UnloadsWithThePoresThatAreLeft) {
  const Rht m = rht();
  for (const double largest : {5e-4, 0.02, 0.1, 0.4}) {
    SinglePoint point(m);
    press_to(point, largest);
    const double alpha = m.alpha(point.state), P = pressure(point);
    if (largest > 0.01 && largest < 0.3) {
      EXPECT_NEAR(P, collapse(alpha), 1e-6 * P);
    }
    const double remains = alpha0 / alpha - 1, half = (largest + remains) / 2;
    press_to(point, half);
    EXPECT_NEAR(pressure(point), solid(alpha * (1 + half) / alpha0 - 1) / alpha, 1e-6 * P);
    press_to(point, remains);
    EXPECT_NEAR(pressure(point), 0, 1e-6 * P);
    EXPECT_EQ(m.alpha(point.state), alpha);
    press_to(point, largest);
    EXPECT_NEAR(pressure(point), P, 1e-6 * P);
  }
}

TEST(Rht, ModulusWhilePoresCollapseIsTheDerivative) {
  const Rht m = rht();
  for (const double mu : {0.002, 0.05, 0.2}) {
    Rht::State state;
    const auto trial = m.press(state, mu);
    const double h = 1e-6, slope = (first_loading(mu + h) - first_loading(mu - h)) / (2 * h);
    EXPECT_NEAR(trial.modulus, slope, 1e-3 * slope);
  }
}

TEST(Rht, TheStepIsStableOnTheStiffestBranch) {
  const Rht m = rht();
  for (const double largest : {5e-4, 0.02, 0.1, 0.4}) {
    SinglePoint point(m);
    press_to(point, largest);
    const double bound = 2314 * std::pow(m.sound_speed(point.state), 2) - 4. / 3 * 16.7 * GPa;
    const double alpha = m.alpha(point.state);
    for (double mu = 0; mu < largest; mu += largest / 20) {
      const double slope = (m.pores.pressure(mu + 1e-7, alpha) - m.pores.pressure(mu, alpha)) / 1e-7;
      EXPECT_LE(slope, bound * (1 + 1e-5));
    }
  }
  EXPECT_NEAR(m.sound_speed({}), std::sqrt((35.27 / 1.1884 + 4. / 3 * 16.7) * GPa / 2314), 1e-6);
}

/// Deviators of triaxial extension, pure shear and triaxial compression.
const Sym3 extension = {2, -1, -1, 0, 0, 0}, pure_shear = {0, 0, 0, 1, 0, 0},
           compression = {-2, 1, 1, 0, 0, 0};

// The four strengths that the constants state, at rest.
TEST(Rht, FailureSurfaceHoldsItsStrengths) {
  const RhtSurface f = rht().surface;
  EXPECT_NEAR(f.failure(1. / 3, 0, compression), 1, 1e-12);
  EXPECT_NEAR(f.failure(0, 0, pure_shear), 0.18, 1e-12);
  EXPECT_NEAR(f.failure(-0.1 / 3, 0, extension), 0.1, 1e-12);
  EXPECT_NEAR(f.failure(-f.tension_limit(0), 0, compression), 0, 1e-12);
  EXPECT_GT(f.failure(-0.99 * f.tension_limit(0), 0, compression), 0);
}

// Uniaxial compression with free sides, at the rate where the rate factor is 1 and a thousand times faster.
TEST(Rht, UniaxialCompressiveStrengthIsFcTimesTheRateFactor) {
  const Rht m = rht();
  for (const double faster : {1., 1000.}) {
    SinglePoint point(m);
    double largest = 0;
    for (int i = 0; i < 1500; ++i) {
      point.advance_with_free_sides(-2e-6, 2e-6 / (faster * 3e-5));
      largest = std::max(largest, -point.stress[0]);
    }
    const double expected = fc * std::pow(faster, 0.032);
    EXPECT_NEAR(largest, expected, 0.02 * expected);
  }
}

TEST(Rht, FailureSurfaceFollowsPressureRateAndLodeAngle) {
  const RhtSurface f = rht().surface;
  for (const double rate : {0., 1., 1e3}) {
    const double F_c = std::pow(std::max(1., rate / 3e-5), 0.032),
                 F_t = std::pow(std::max(1., rate / 3e-6), 0.036);
    for (const double P : {1., 3., 20.}) { // over fc
      const double meridian = 1.6 * std::pow(P - F_c / 3 + std::pow(1.6 / F_c, -1 / 0.61), 0.61);
      EXPECT_NEAR(f.failure(P, rate, compression), meridian, 1e-10);
      EXPECT_NEAR(f.failure(P, rate, extension), meridian * std::min(1., 0.6805 + 0.0105 * P), 1e-10);
    }
    EXPECT_DOUBLE_EQ(f.rate_factor(F_c / 3, rate), F_c);
    EXPECT_DOUBLE_EQ(f.rate_factor(-F_t * 0.1 / 3, rate), F_t);
    EXPECT_NEAR(f.tension_limit(rate), F_t * f.tension_limit(0), 1e-12);
    for (const double P : {F_c / 3, 0.}) // its pieces meet
      EXPECT_NEAR(f.failure(P - 1e-9, rate, pure_shear), f.failure(P + 1e-9, rate, pure_shear), 1e-6);
  }
}

TEST(Rht, FlowsFirstAtTheElasticLimitAndHardensToTheFailureSurface) {
  const Rht m = rht({"EPM=1e9"});
  const RhtSurface& f = m.surface;
  // Below the cap the elastic limit is g f(P / g); at rest.
  const double P = 0.53 / 3 * fc;
  EXPECT_NEAR(m.strength({}, P, 0, 0, compression), 0.53 * f.failure(1. / 3, 0, compression) * fc, 1);
  EXPECT_NEAR(m.strength({}, -0.07 / 3 * fc, 0, 0, compression),
              0.7 * f.failure(-0.1 / 3, 0, compression) * fc, 1);
  EXPECT_LT(m.strength({}, 23.3e6, 0, 0, compression), 1e-2 * fc) << "closed where pores collapse";
  for (const double mu : {5e-4, 0.05, 0.15})
    for (const double rate : {1e-2, 1e2}) {
      SinglePoint point(m);
      press_to(point, mu);
      shear(point, 20, rate);
      shear(point, 4000, rate);
      ASSERT_EQ(point.state.hardening, 1);
      EXPECT_EQ(point.state.shear_damage < 1e-6, true);
      const double expected = fc * f.failure(pressure(point) / fc, rate, pure_shear);
      EXPECT_NEAR(equivalent_stress(deviator(point.stress)), expected, 1e-6 * expected);
    }
}

TEST(Rht, HardeningTakesTheStrainBetweenTheSurfaces) {
  const Rht m = rht();
  const double P = 4 * fc, gap = m.surface.failure(4, 0, pure_shear) * (1 - 0.53) * fc;
  EXPECT_NEAR(m.hardening_strain(P, 0, pure_shear), gap / (3 * 0.5 * 16.7 * GPa), 1e-12);
  Rht::State state;
  m.harm(state, gap / (3 * 0.5 * 16.7 * GPa) / 4, 0, P, 0, pure_shear);
  EXPECT_NEAR(state.hardening, 0.25, 1e-9);
  EXPECT_EQ(state.shear_damage, 0);
}

TEST(Rht, DamageLeadsToTheResidualStrength) {
  const Rht m = rht();
  Rht::State state;
  state.hardening = 1;
  const double P = 3 * fc, limit = m.surface.tension_limit(0);
  m.harm(state, 1e-3, 0, P, 0, pure_shear);
  EXPECT_NEAR(state.shear_damage, 1e-3 / (0.04 * (3 + limit)), 1e-12);
  EXPECT_DOUBLE_EQ(m.failure_strain(0, 1, 0), 0.01) << "EPM";
  state.shear_damage = 0.5;
  const double intact = m.surface.failure(3, 0, pure_shear), residual = 1.6 * std::pow(3., 0.61);
  EXPECT_NEAR(m.strength(state, P, 0, 0, pure_shear), (intact + residual) / 2 * fc, 1);
  EXPECT_NEAR(m.tension_limit(state, 0), limit / 2 * fc, 1);
  state.shear_damage = 1;
  EXPECT_EQ(m.strength(state, 0, 0, 0, pure_shear), 0);
  // Driven to failure at constant volume.
  SinglePoint point(m);
  press_to(point, 0.02);
  shear(point, 40000);
  EXPECT_EQ(point.state.shear_damage, 1);
  const double end = 1.6 * std::pow(pressure(point) / fc, 0.61) * fc;
  EXPECT_NEAR(equivalent_stress(deviator(point.stress)), end, 1e-6 * end);
}

TEST(Rht, MeanTensionIsCutAtItsLimit) {
  const Rht m = rht({"EPM=1e9"});
  SinglePoint point(m);
  const double e = 1e-3 / 3 / 1000, limit = m.surface.tension_limit(0) * fc;
  const double Q1 = 0.76167; // Willam-Warnke at 30 degrees with Q0, by hand
  EXPECT_NEAR(limit, 0.6805 * 0.18 * 0.1 / (3 * (0.6805 * 0.18 - Q1 * 0.1)) * fc, 1e-3 * MPa);
  for (int i = 0; i < 1000; ++i) point.advance({e, e, e, 0, 0, 0}, 1);
  EXPECT_NEAR(-pressure(point), limit, 1e-6 * limit);
}

TEST(Rht, GivesBackWhatTheSolidStoresAndNoMore) {
  const Rht m = rht();
  for (const double largest : {5e-4, 0.05, 0.4}) {
    SinglePoint point(m);
    press_to(point, largest, 20000);
    const double before = point.work, stored = m.stored_energy(point.stress, point.state).total();
    press_to(point, m.pores.plastic_strain(m.alpha(point.state)), 20000);
    EXPECT_NEAR(before - point.work, stored, 1e-5 * stored);
    if (largest < 6e-4)
      EXPECT_NEAR(point.work, 0, 1e-5 * stored);
    else
      EXPECT_GT(point.work, stored / 3);
  }
}

TEST(Rht, RotatedPathGivesRotatedStress) {
  const Rht m = rht();
  const Mat3 r = rotation();
  SinglePoint point(m), rotated(m);
  RandomStrain strain(5e-5);
  for (int i = 0; i < 300; ++i) {
    const Sym3 e = plus_spherical(strain(), -1e-5);
    point.advance(e, dt);
    rotated.advance(rotate(r, e), dt);
  }
  const Sym3 expected = rotate(r, point.stress);
  EXPECT_SAME_STRESS(rotated.stress, expected, 1e-7 * fc);
  EXPECT_NEAR(rotated.state.hardening, point.state.hardening, 1e-7);
  EXPECT_GT(point.state.hardening, 0);
}

TEST(Rht, WithTheDamageTableTensionIsThatOfTheCell) {
  Rht m = rht({"Tensile rate law=constant", "Crack band=1", "EPM=1e9"});
  m.tension.law = Tension::damage_table;
  Afc elastic;
  elastic.G = m.G, elastic.hydrostat.C6 = m.bulk_modulus(), elastic.hydrostat.C7 = 1;
  const double limit = m.surface.tension_limit(0) * fc;
  m.tension.tensile.use(cracking_cell(elastic, 8e-3, limit, 80), {8e-3});
  SinglePoint point(m, 8e-3);
  double largest = 0;
  for (int i = 0; i < 40000 && point.state.tensile_damage < 1; ++i) {
    point.advance({1e-6, 0, 0, 0, 0, 0}, 1);
    largest = std::max(largest, -pressure(point));
  }
  ASSERT_EQ(point.state.tensile_damage, 1);
  EXPECT_NEAR(largest, limit, 1e-2 * limit);
  EXPECT_NEAR(largest_component(point.stress), 0, 1e3);
  // As the point of Hjc: between the energy of the cell and that with the stress of uniaxial strain.
  const double ratio = (m.bulk_modulus() + 4. / 3 * m.G) / m.bulk_modulus();
  EXPECT_GT(point.work * 8e-3, 80);
  EXPECT_LT(point.work * 8e-3, 80 * ratio * ratio);
}

TEST(Rht, RefusesWhatDoesNotFitTogether) {
  const auto message = [](const std::vector<std::string>& changes) {
    return refusal("concrete_35_rht", changes);
  };
  EXPECT_EQ(message({}), "");
  EXPECT_NE(message({"RHT/Pcomp=10 MPa"}).find("RHT/Pcomp': found '1e+07 Pa', allowed: > Pel"),
            std::string::npos)
      << message({"RHT/Pcomp=10 MPa"});
  EXPECT_NE(message({"RHT/A2=-60 GPa"}).find("RHT/A2"), std::string::npos);
  EXPECT_NE(message({"RHT/ft*=0.3"}).find("does not fall to zero in tension"), std::string::npos);
  EXPECT_NE(message({"RHT/Tension=damage table"}).find("RHT/Damage table"), std::string::npos);
}

} // namespace
} // namespace spall::test::of_rht
