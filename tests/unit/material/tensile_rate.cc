#include "tests/unit/material/cracking_cell.h"

#include <gtest/gtest.h>

namespace spall::test {
namespace {

constexpr TensileRateLaw laws[] = {TensileRateLaw::malvar_crawford, TensileRateLaw::ceb_1990,
                                   TensileRateLaw::fib_2010};

TEST(TensileRate, IsOneAtRestAndGrowsWithTheRate) {
  for (const TensileRateLaw law : laws) {
    const TensileRate factor{.law = law};
    EXPECT_EQ(factor(0), 1);
    EXPECT_EQ(factor(1e-6), 1);
    double before = 1;
    for (double rate = 1e-6; rate < 1e3; rate *= 1.01) {
      EXPECT_GE(factor(rate), 0.98 * before)
          << rate; // the branches of the code formulas differ by 1 to 2 % where they meet
      before = factor(rate);
    }
  }
}

TEST(TensileRate, GrowsWithTheCubeRootBeyondTheBendAndIsHeldAtTheEnd) {
  const std::tuple<TensileRateLaw, double, double> ranges[] = {{TensileRateLaw::malvar_crawford, 1, 160},
                                                               {TensileRateLaw::ceb_1990, 30, 300},
                                                               {TensileRateLaw::fib_2010, 10, 300}};
  for (const auto& [law, bend, last] : ranges) {
    const TensileRate factor{.law = law, .largest = 100};
    EXPECT_NEAR(factor(last) / factor(1.001 * bend), std::cbrt(last / bend / 1.001), 1e-9);
    EXPECT_EQ(factor(100 * last), factor(last));
  }
}

TEST(TensileRate, IsHeldAtTheLargestFactorThatIsAllowed) {
  for (const TensileRateLaw law : laws) {
    const TensileRate factor{.law = law, .largest = 1.5}, free{.law = law, .largest = 100};
    for (const double rate : {1e-6, 1., 1e3}) EXPECT_EQ(factor(rate), std::min(1.5, free(rate)));
  }
  EXPECT_EQ((TensileRate{.law = TensileRateLaw::constant, .constant = 9}(1)), 9);
  // The test that it is taken from, and what the mean curve of others has there.
  EXPECT_EQ(TensileRate{}(37.1), 4.07);
  EXPECT_NEAR((TensileRate{.largest = 100}(37.1)), 5.2, 0.05);
}

TEST(TensileRate, HasTheValuesOfItsSources) {
  // Tests collected by Malvar and Ross (1998), mean curve: 1.45, 3.12, 6.72 at 1, 10, 100 1/s (strength about
  // 45 MPa).
  const TensileRate malvar{
      .law = TensileRateLaw::malvar_crawford, .compressive_strength = 45e6, .largest = 100};
  EXPECT_NEAR(malvar(1), 1.45, 0.01);
  EXPECT_NEAR(malvar(10), 3.12, 0.02);
  EXPECT_NEAR(malvar(100), 6.72, 0.04);
  const TensileRate fib{.law = TensileRateLaw::fib_2010};
  EXPECT_NEAR(fib(1), std::pow(1e6, 0.018), 1e-12);
  EXPECT_NEAR(fib(100), 0.0062 * std::cbrt(1e8), 1e-12);
  const TensileRate ceb{.law = TensileRateLaw::ceb_1990, .compressive_strength = 30e6};
  EXPECT_NEAR(ceb(3e-6 * 1e6), std::pow(1e6, 1.016 / 28), 1e-9);
}

TEST(TensileRate, RaisesTheTensionLimitWhileThePointPullsFast) {
  const Afc afc = wes5000({"AFC/Tensile rate law=fib 2010"});
  for (const double rate : {1., 10., 100.}) {
    SinglePoint point(afc);
    double peak = 0;
    for (int i = 0; i < 2000; ++i) {
      point.advance({1e-6, 0, 0, 0, 0, 0}, 1e-6 / rate);
      peak = std::max(peak, trace(point.stress) / 3);
    }
    const TensileRate factor{.law = TensileRateLaw::fib_2010};
    EXPECT_NEAR(peak / MPa, 2.47 * factor(rate), 1e-6) << "uniaxial strain at " << rate;
    EXPECT_NEAR(point.state.tensile_rate_factor, factor(rate), 1e-9);
  }
}

// A bar behind a pulse of pressure swings sideways: its mean stress is pressure, its largest one tension.
TEST(TensileRate, RaisesTheLimitOfThePrincipalStressUnderPressureToo) {
  const Afc afc = wes5000({"AFC/Tensile rate law=fib 2010", "AFC/Tension limits=principal stress"});
  for (const double rate : {1., 10., 30.}) { // faster ones crush it first
    SinglePoint point(afc);
    const double sideways = 0.45, step = 1e-6;
    double peak = 0;
    for (int i = 0; i < 1500; ++i) {
      const double dt = step * std::sqrt(1 + 2 * sideways * sideways) / rate;
      point.advance({-step, sideways * step, sideways * step, 0, 0, 0}, dt);
      EXPECT_LT(trace(point.stress), 0);
      peak = std::max(peak, point.stress[1]);
    }
    const TensileRate factor{.law = TensileRateLaw::fib_2010};
    EXPECT_NEAR(peak / MPa / (2.47 * factor(rate)), 1, 0.01) << rate;
  }
}

// The strength must not follow the rate while the crack opens, because that would create energy.
TEST(TensileRate, IsHeldOnceThePointHasOpened) {
  const Afc afc = wes5000({"AFC/Tensile rate law=fib 2010"});
  SinglePoint point(afc);
  const auto pull = [&](double strain, double rate) {
    for (int i = 0; i < 100; ++i) point.advance({strain / 100, 0, 0, 0, 0, 0}, std::abs(strain) / 100 / rate);
    return trace(point.stress) / 3;
  };
  const double limit = pull(1e-3, 10);
  EXPECT_NEAR(pull(1e-3, 100), limit, 1e-6);
  EXPECT_NEAR(pull(1e-3, 0.1), limit, 1e-6);
  EXPECT_NEAR(pull(-1e-3, 100), 2. / 3 * limit, 1e-6 * MPa); // the secant
  EXPECT_NEAR(pull(1e-3, 100), limit, 1e-6 * MPa);
}

TEST(TensileRate, ScalesTheEnergyPerCrackAreaAlike) {
  Afc afc = wes5000({"AFC/Tensile rate law=fib 2010"});
  afc.tensile.use(cracking_cell(afc, 16e-3, 2.47 * MPa, 80), {4e-3});
  for (const double rate : {10., 100.}) {
    SinglePoint point(afc);
    for (int i = 0; i < 40000; ++i) point.advance({20e-3 / 40000, 0, 0, 0, 0, 0}, 20e-3 / 40000 / rate);
    EXPECT_NEAR(point.work * 4e-3, 80 * afc.tensile.rate(rate), 0.03 * 80 * afc.tensile.rate(rate));
  }
}

} // namespace
} // namespace spall::test
