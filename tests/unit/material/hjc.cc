// The concrete of Holmquist, Johnson and Cook at a point against its own equations. The numbers are those of
// concrete_48_hjc.prm, written down a second time.

#include "shared/error.h"
#include "tests/unit/material/cracking_cell.h"

#include <gtest/gtest.h>

namespace spall::test::of_hjc {
namespace {

constexpr double GPa = 1e9, dt = 1e-6;

Hjc hjc(std::vector<std::string> changes = {}) {
  for (std::string& change : changes) change = "HJC/" + change;
  Material made = material("concrete_48_hjc", changes);
  prepare(made, {8e-3});
  return std::get<Hjc>(made);
}

double dense(double mu) {
  const double m = (mu - 0.1) / 1.1;
  return (85 * m - 171 * m * m + 208 * m * m * m) * GPa;
}
/// mu where the dense curve has 800 MPa, by bisection.
double mu_L() {
  double low = 0.1, high = 0.2;
  for (int i = 0; i < 100; ++i) (dense((low + high) / 2) < 800 * MPa ? low : high) = (low + high) / 2;
  return low;
}

/// Changes the volume of a point evenly until mu = density over initial density - 1 is this.
void press_to(SinglePoint<Hjc>& point, double mu, int steps = 2000) {
  const double e = (-std::log1p(mu) - trace(point.strain)) / 3 / steps;
  for (int i = 0; i < steps; ++i) point.advance({e, e, e, 0, 0, 0}, dt);
}
double pressure(const SinglePoint<Hjc>& point) { return -trace(point.stress) / 3; }

TEST(Hjc, PressureIsElasticCrushingAndDense) {
  const Hjc m = hjc();
  SinglePoint point(m);
  press_to(point, 0.0005);
  EXPECT_NEAR(pressure(point), 8 * MPa, 10);
  press_to(point, 0.001);
  EXPECT_NEAR(pressure(point), 16 * MPa, 10);
  press_to(point, 0.05);
  EXPECT_NEAR(pressure(point), (16 + 784 * 0.049 / (mu_L() - 0.001)) * MPa, 10);
  press_to(point, mu_L() - 1e-9);
  EXPECT_NEAR(pressure(point), 800 * MPa, 100);
  press_to(point, mu_L() + 1e-9);
  EXPECT_NEAR(pressure(point), 800 * MPa, 100) << "no jump";
  for (const double mu : {0.12, 0.2, 0.3}) {
    press_to(point, mu);
    EXPECT_NEAR(pressure(point), dense(mu), 1e-9 * dense(mu));
  }
}

TEST(Hjc, UnloadsWithASlopeBetweenTheElasticAndTheDense) {
  const Hjc m = hjc();
  const double K_L = 800 * MPa / (mu_L() - 0.1), lock = mu_L();
  for (const double share : {0., 0.25, 0.9}) {
    SinglePoint point(m);
    const double largest = 0.001 + share * (lock - 0.001), K = 16 * GPa + share * (K_L - 16 * GPa);
    press_to(point, largest);
    const double P = pressure(point);
    press_to(point, largest - 0.5 * P / K);
    EXPECT_NEAR(pressure(point), 0.5 * P, 1e-6 * P);
    press_to(point, largest);
    EXPECT_NEAR(pressure(point), P, 1e-9 * P) << "reloading goes the same way";
    EXPECT_NEAR(m.sound_speed(point.state), std::sqrt((K + 4. / 3 * 14.86 * GPa) / 2440), 1e-6);
  }
}

TEST(Hjc, ADensePointUnloadsAlongTheDenseCurveToMuLock) {
  const Hjc m = hjc();
  SinglePoint point(m);
  press_to(point, 0.25);
  for (const double mu : {0.2, 0.12, 0.101}) {
    press_to(point, mu);
    EXPECT_NEAR(pressure(point), dense(mu), 1e-8 * dense(mu));
  }
  press_to(point, 0.1);
  EXPECT_NEAR(pressure(point), 0, 100);
}

TEST(Hjc, TheStepIsStableOnTheStiffestBranch) {
  const Hjc m = hjc();
  for (const double largest : {0., 5e-4, 0.03, 0.11, 0.13, 0.4, 1.}) {
    Hjc::State state;
    state.largest_compression = largest;
    const double bound = 2440 * std::pow(m.sound_speed(state), 2) - 4. / 3 * 14.86 * GPa;
    for (double mu = 0; mu < largest; mu += largest / 50) {
      const double slope = (m.curve(mu + 1e-7, largest).pressure - m.curve(mu, largest).pressure) / 1e-7;
      EXPECT_LE(slope, bound * (1 + 1e-5)) << mu << " " << largest;
    }
  }
}

// Sheared at constant volume until it flows, before damage can count.
TEST(Hjc, StrengthFollowsPressureAndRate) {
  const Hjc m = hjc({"EFMIN=1e9"});
  for (const double mu : {0.0, 0.001, 0.02, 0.08, 0.15})
    for (const double rate : {1e-3, 1., 1e3}) {
      SinglePoint point(m);
      if (mu > 0) press_to(point, mu);
      const double P = pressure(point), shear = 2e-5, step = 2 / std::sqrt(3.) * shear / rate;
      for (int i = 0; i < 2000; ++i) point.advance({0, 0, 0, shear, 0, 0}, step);
      const double expected =
          std::min(7., (0.79 + 1.6 * std::pow(P / 48e6, 0.61)) * (1 + 0.007 * std::log(rate))) * 48 * MPa;
      EXPECT_NEAR(equivalent_stress(deviator(point.stress)), expected, 1e-6 * expected) << mu << " " << rate;
    }
  Hjc::State damaged;
  damaged.shear_damage = 1;
  EXPECT_NEAR(m.strength(damaged, 48e6, 0, 1, {}), 1.6 * 48 * MPa, 1);
  EXPECT_EQ(m.strength(damaged, 0, 0, 1, {}), 0);
  EXPECT_EQ(m.strength({}, 1e12, 0, 1, {}), 7 * 48 * MPa);
}

TEST(Hjc, StrengthFallsToZeroAtTheTensionLimit) {
  const Hjc m = hjc();
  for (const double D : {0., 0.5}) {
    Hjc::State state;
    state.shear_damage = D;
    const double limit = m.tension_limit(state, 1);
    EXPECT_DOUBLE_EQ(limit, 4 * MPa * (1 - D));
    EXPECT_NEAR(m.strength(state, -limit / 2, limit, 1, {}), 0.79 * (1 - D) / 2 * 48 * MPa, 1);
    EXPECT_EQ(m.strength(state, -limit, limit, 1, {}), 0);
  }
}

TEST(Hjc, DamageIsPlasticStrainAndCrushedVolumeOverTheStrainToFailure) {
  const Hjc m = hjc();
  EXPECT_DOUBLE_EQ(m.failure_strain(0), 0.01); // 0.04 * 4 / 48 = 0.0033 is below EFMIN
  EXPECT_DOUBLE_EQ(m.failure_strain(92e6), 0.08);
  EXPECT_DOUBLE_EQ(m.failure_strain(-4e6), 0.01);
  SinglePoint point(m);
  const auto e_f = [](double P) { return std::max(0.01, 0.04 * (P + 4e6) / 48e6); };
  // What stays when it is unloaded from mu, and the pressure there.
  const double K_L = 800 * MPa / (mu_L() - 0.1), lock = mu_L();
  const auto P_of = [&](double mu) { return (16 + 784 * (mu - 0.001) / (lock - 0.001)) * MPa; };
  const auto stays = [&](double mu) {
    return mu - P_of(mu) / (16 * GPa + (K_L - 16 * GPa) * (mu - 0.001) / (lock - 0.001));
  };
  double expected = 0;
  for (double mu = 0.001; mu < 0.003 - 1e-9; mu += 1e-6)
    expected += (stays(mu + 1e-6) - stays(mu)) / e_f(P_of(mu + 5e-7));
  press_to(point, 0.003, 20000);
  EXPECT_NEAR(point.state.shear_damage, expected, 1e-3 * expected);
  // Sheared on at constant pressure.
  const double P = pressure(point), before = point.state.shear_damage;
  for (int i = 0; i < 200; ++i) point.advance({0, 0, 0, 2e-5, 0, 0}, dt);
  ASSERT_GT(point.state.plastic_strain, 1e-4);
  ASSERT_LT(point.state.shear_damage, 1);
  EXPECT_NEAR(point.state.shear_damage - before, point.state.plastic_strain / e_f(P), 1e-9);
}

TEST(Hjc, MeanTensionIsCutAtItsLimitAndClosesAlongTheSecant) {
  const Hjc m = hjc({"Opened volume kept=0"});
  SinglePoint point(m);
  const auto pull = [&](double e) {
    for (int i = 0; i < 1000; ++i) point.advance({e / 3000, e / 3000, e / 3000, 0, 0, 0}, dt);
  };
  pull(2e-4);
  EXPECT_NEAR(-pressure(point), 16 * GPa * 2e-4, 1e-3 * MPa);
  pull(8e-4);
  EXPECT_NEAR(-pressure(point), 4 * MPa, 1);
  const double stored = m.stored_energy(point.stress, point.state).total(), work = point.work;
  EXPECT_NEAR(stored, 4 * MPa * 1e-3 / 2, 5);
  pull(-5e-4);
  EXPECT_NEAR(-pressure(point), 2 * MPa, 2e-3 * MPa);
  pull(-5e-4);
  EXPECT_NEAR(pressure(point), 0, 1e-3 * MPa);
  EXPECT_NEAR(work - point.work, stored, 2e-3 * stored);
}

TEST(Hjc, WithACutOffMeanTensionStaysAndClosesOnTheWayItOpened) {
  const Hjc m = hjc({"Opening=cut-off", "Opened volume kept=0"});
  SinglePoint point(m);
  const auto pull = [&](double e) {
    for (int i = 0; i < 1000; ++i) point.advance({e / 3000, e / 3000, e / 3000, 0, 0, 0}, dt);
  };
  pull(1e-3);
  for (const double back : {-3e-4, -3e-4}) {
    pull(back);
    EXPECT_NEAR(-pressure(point), 4 * MPa, 1);
  }
  pull(-4e-4);
  EXPECT_NEAR(pressure(point), 0, 1e-3 * MPa);
  EXPECT_NEAR(point.work, 0, 1);
}

TEST(Hjc, GivesBackWhatTheDenseCurveStores) {
  const Hjc m = hjc();
  SinglePoint point(m);
  press_to(point, 0.3, 20000);
  const double before = point.work, stored = m.stored_energy(point.stress, point.state).total();
  press_to(point, 0.1, 20000);
  EXPECT_NEAR(before - point.work, stored, 1e-5 * stored);
  EXPECT_GT(point.work, 0);
  press_to(point, 0.3, 20000);
  EXPECT_NEAR(point.work, before, 1e-5 * stored);
}

TEST(Hjc, CrushingIsDissipated) {
  const Hjc m = hjc();
  SinglePoint point(m);
  press_to(point, 0.06, 20000);
  const double before = point.work, stored = m.stored_energy(point.stress, point.state).total();
  press_to(point, m.curve.plastic_strain(0.06), 20000);
  EXPECT_NEAR(pressure(point), 0, 1e3);
  EXPECT_NEAR(before - point.work, stored, 1e-5 * stored);
  EXPECT_GT(point.work, 3 * stored);
}

TEST(Hjc, RotatedPathGivesRotatedStress) {
  const Hjc m = hjc();
  const Mat3 r = rotation();
  SinglePoint point(m), rotated(m);
  RandomStrain strain(5e-5);
  for (int i = 0; i < 300; ++i) {
    const Sym3 e = plus_spherical(strain(), -1e-5);
    point.advance(e, dt);
    rotated.advance(rotate(r, e), dt);
  }
  const Sym3 expected = rotate(r, point.stress);
  EXPECT_SAME_STRESS(rotated.stress, expected, 1e-8 * m.fc);
  EXPECT_NEAR(rotated.state.shear_damage, point.state.shear_damage, 1e-9);
  EXPECT_GT(point.state.shear_damage, 0);
}

/// A cell of this concrete that cracks at 4 MPa with 80 N/m.
DamageTable cell_of(const Hjc& m) {
  Afc elastic;
  elastic.G = m.G, elastic.hydrostat.C6 = 16 * MPa, elastic.hydrostat.C7 = 0.001;
  return cracking_cell(elastic, 8e-3, 4 * MPa, 80);
}

TEST(Hjc, WithTheDamageTableDissipatesTheFractureEnergyOfTheCell) {
  Hjc m = hjc({"Tensile rate law=constant", "Crack band=1"});
  m.tension.law = Tension::damage_table;
  m.tension.tensile.use(cell_of(m), {8e-3});
  SinglePoint point(m, 8e-3);
  for (int i = 0; i < 40000 && point.state.tensile_damage < 1; ++i) point.advance({1e-6, 0, 0, 0, 0, 0}, 1);
  ASSERT_EQ(point.state.tensile_damage, 1);
  // The cell cracks at 4 MPa of stress, the point at 4 MPa of mean stress, with the same opening: its work is
  // larger by stress over mean stress in uniaxial strain at most, and not below that of the cell.
  const double K = 16 * GPa, ratio = (K + 4. / 3 * m.G) / K;
  EXPECT_GT(point.work * 8e-3, 80);
  EXPECT_LT(point.work * 8e-3, 80 * ratio * ratio);
  EXPECT_NEAR(largest_component(point.stress), 0, 1e3);
}

TEST(Hjc, RefusesWhatDoesNotFitTogether) {
  const auto message = [](const std::vector<std::string>& changes) {
    return refusal("concrete_48_hjc", changes);
  };
  EXPECT_EQ(message({}), "");
  EXPECT_NE(message({"HJC/mu lock=0.0005"}).find("HJC/mu lock': found '5e-04', allowed: > mu crush"),
            std::string::npos);
  EXPECT_NE(message({"HJC/Plock=10 MPa"}).find("HJC/Plock"), std::string::npos);
  EXPECT_NE(message({"HJC/Plock=20 GPa"}).find("softer while it crushes"), std::string::npos);
  EXPECT_NE(message({"HJC/K1=15 GPa", "HJC/K2=0 GPa"}).find("HJC/K1"), std::string::npos);
  EXPECT_NE(message({"HJC/K2=-300 GPa"}).find("HJC/K2"), std::string::npos);
  EXPECT_NE(message({"HJC/Damage table=/t.h5"}).find("allowed: none with Tension = own"), std::string::npos);
  EXPECT_NE(message({"HJC/Tension=damage table"}).find("HJC/Damage table': found ''"), std::string::npos);
}

} // namespace
} // namespace spall::test::of_hjc
