// Every softening branch: the area is the fracture energy, whatever the shape.

#include "micro/cohesive/cohesive_law.h"
#include "micro/cohesive/node_response.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace {

using namespace spall;

constexpr double ft = 3e6, Gf = 80;

struct Law : testing::TestWithParam<Softening> {
  const std::unique_ptr<CohesiveLaw> law = make_cohesive_law(GetParam(), ft, Gf);
  const double wf = law->final_opening();
};

TEST_P(Law, StartsAtTheStrengthEndsAtZeroAndFallsInBetween) {
  EXPECT_NEAR(law->traction(0), ft, 1e-9 * ft);
  EXPECT_NEAR(law->traction(wf), 0, 1e-9 * ft);
  for (double w = 0; w < wf; w += 0.01 * wf) {
    EXPECT_LT(law->slope(w), 0);
    EXPECT_LE(-law->slope(w), law->steepest_slope() * (1 + 1e-12));
  }
}

TEST_P(Law, WorkIsTheIntegralOfTheTractionAndEndsAtTheFractureEnergy) {
  double area = 0;
  const int steps = 3600; // a multiple of Petersson's knee at 0.8 / 3.6
  for (int i = 0; i < steps; ++i) {
    area += 0.5 * wf / steps * (law->traction(wf * i / steps) + law->traction(wf * (i + 1) / steps));
    ASSERT_NEAR(area, law->work(wf * (i + 1) / steps), 2e-6 * Gf);
  }
  EXPECT_NEAR(law->work(wf), Gf, 1e-12 * Gf);
  EXPECT_NEAR(law->dissipation(wf), Gf, 1e-9 * Gf);
}

TEST_P(Law, SlopesAreDerivatives) {
  const double h = 1e-6 * wf;
  for (const double w : {0.05 * wf, 0.15 * wf, 0.4 * wf, 0.9 * wf}) {
    EXPECT_NEAR((law->traction(w + h) - law->traction(w - h)) / (2 * h), law->slope(w),
                1e-6 * law->steepest_slope());
    EXPECT_NEAR((law->dissipation(w + h) - law->dissipation(w - h)) / (2 * h), law->dissipation_slope(w),
                1e-6 * ft);
  }
  EXPECT_EQ(law->dissipation_slope(wf), 0);
}

TEST_P(Law, NodeInvertsItExactly) {
  std::mt19937 random(3);
  for (int i = 0; i < 2000; ++i) {
    const double a = law->steepest_slope() * (2 + random() % 100);
    const double w = wf * (0.001 + 0.998 * (random() % 10000) / 10000.0);
    const NodeResponse r = node_response(*law, {}, a, {}, {law->traction(w) + a * w, 0});
    ASSERT_NEAR(r.opening[0], w, 1e-12 * wf);
    ASSERT_TRUE(r.loading);
  }
}

INSTANTIATE_TEST_SUITE_P(All, Law,
                         testing::Values(Softening::linear, Softening::bilinear, Softening::exponential));

// Pure shear up to failure: its own strength and its own energy; pure tension is untouched.
TEST(MixedMode, ShearHasItsOwnStrengthAndEnergy) {
  const auto law = make_cohesive_law(Softening::linear, ft, Gf);
  const MixedMode mode{.strength_ratio = 2.5, .energy_ratio = 4};
  const double a = 5 * law->steepest_slope(), weight = mode.traction_weight();
  EXPECT_EQ(node_response(*law, mode, a, {}, {0, 0.999 * 2.5 * ft}).opening[1], 0);
  EXPECT_GT(node_response(*law, mode, a, {}, {0, 1.001 * 2.5 * ft}).opening[1], 0);
  double energy = 0, last_w = 0, last_t = 2.5 * ft;
  const double end = a * weight * law->final_opening() / mode.opening_weight();
  for (int i = 1; i <= 2000; ++i) {
    const double p = 2.5 * ft + (end - 2.5 * ft) * i / 2000;
    const double w = node_response(*law, mode, a, {}, {0, p}).opening[1], t = p - a * weight * w;
    energy += 0.5 * (t + last_t) * (w - last_w);
    last_w = w;
    last_t = t;
  }
  EXPECT_NEAR(last_t, 0, 1e-6 * ft);
  EXPECT_NEAR(energy, 4 * Gf, 1e-5 * Gf);
  const double w = 0.3 * law->final_opening();
  EXPECT_NEAR(node_response(*law, mode, a, {}, {law->traction(w) + a * w, 0}).opening[0], w, 1e-12 * w);
}

TEST(MixedMode, TangentIsTheDerivativeOfTheTraction) {
  const auto law = make_cohesive_law(Softening::exponential, ft, Gf);
  const MixedMode mode{.strength_ratio = 1.7, .energy_ratio = 3};
  const double a = 4 * law->steepest_slope();
  const auto traction = [&](const Eigen::Vector2d& w) {
    const double d = mode.effective(w);
    return Eigen::Vector2d(law->traction(d) / d * w[0], mode.traction_weight() * law->traction(d) / d * w[1]);
  };
  const NodeResponse r = node_response(*law, mode, a, {}, {3 * ft, 5 * ft});
  ASSERT_GT(r.opening[0], 0);
  for (int c = 0; c < 2; ++c) {
    const Eigen::Vector2d h = 1e-6 * law->final_opening() * Eigen::Vector2d::Unit(c);
    const Eigen::Vector2d difference =
        (traction(r.opening + h) - traction(r.opening - h)) / (2e-6 * law->final_opening());
    EXPECT_LE((r.tangent.col(c) - difference).norm(), 1e-6 * law->steepest_slope());
  }
}

TEST(Friction, HoldsUpToTheConeAndThenSlidesOnIt) {
  const auto law = make_cohesive_law(Softening::linear, ft, Gf);
  const MixedMode mode{.friction = 0.5};
  const double a = 3 * law->steepest_slope(), wf = law->final_opening(), slip = 0.2 * wf, pressure = 10 * ft;
  const NodeHistory broken{.largest = wf, .slip = slip};
  for (const double share : {-0.99, 0.0, 0.99}) {
    const NodeResponse held =
        node_response(*law, mode, a, broken, {-pressure, a * slip + share * 0.5 * pressure});
    EXPECT_EQ(held.opening[1], slip);
    EXPECT_FALSE(held.free[1]);
  }
  for (const double side : {1.0, -1.0}) {
    const double p = a * slip + side * 0.7 * pressure;
    const NodeResponse sliding = node_response(*law, mode, a, broken, {-pressure, p});
    EXPECT_EQ(sliding.friction, side * 0.5);
    EXPECT_NEAR(p - a * sliding.opening[1], side * 0.5 * pressure,
                1e-9 * pressure); // traction left: the cone
    EXPECT_GT(side * (sliding.opening[1] - slip), 0);
  }
}

} // namespace
