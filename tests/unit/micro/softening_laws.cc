// Tests of every softening branch: the area is the fracture energy for any shape.

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
  const int steps = 3600; // so that a step ends at the knee of Petersson's law, at 0.8 / 3.6
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
    const NodeResponse<2> r = node_response<2>(*law, {}, a, {}, {law->traction(w) + a * w, 0});
    ASSERT_NEAR(r.opening[0], w, 1e-12 * wf);
    ASSERT_TRUE(r.loading);
  }
}

std::vector<Softening> all_laws() {
  std::vector<Softening> all;
  for (const auto& [word, softening] : softening_words()) all.push_back(softening);
  return all;
}
INSTANTIATE_TEST_SUITE_P(All, Law, testing::ValuesIn(all_laws()), [](const auto& law) {
  for (const auto& [word, softening] : softening_words())
    if (softening == law.param) return word;
  return std::string("none");
});

// Pure shear up to failure has its own strength and energy; pure tension does not change.
TEST(MixedMode, ShearHasItsOwnStrengthAndEnergy) {
  const auto law = make_cohesive_law(Softening::linear, ft, Gf);
  const MixedMode mode{.strength_ratio = 2.5, .energy_ratio = 4};
  const double a = 5 * law->steepest_slope(), weight = mode.traction_weight();
  EXPECT_EQ(node_response<2>(*law, mode, a, {}, {0, 0.999 * 2.5 * ft}).opening[1], 0);
  EXPECT_GT(node_response<2>(*law, mode, a, {}, {0, 1.001 * 2.5 * ft}).opening[1], 0);
  double energy = 0, last_w = 0, last_t = 2.5 * ft;
  const double end = a * weight * law->final_opening() / mode.opening_weight();
  for (int i = 1; i <= 2000; ++i) {
    const double p = 2.5 * ft + (end - 2.5 * ft) * i / 2000;
    const double w = node_response<2>(*law, mode, a, {}, {0, p}).opening[1], t = p - a * weight * w;
    energy += 0.5 * (t + last_t) * (w - last_w);
    last_w = w;
    last_t = t;
  }
  EXPECT_NEAR(last_t, 0, 1e-6 * ft);
  EXPECT_NEAR(energy, 4 * Gf, 1e-5 * Gf);
  const double w = 0.3 * law->final_opening();
  EXPECT_NEAR(node_response<2>(*law, mode, a, {}, {law->traction(w) + a * w, 0}).opening[0], w, 1e-12 * w);
}

TEST(MixedMode, TangentIsTheDerivativeOfTheTraction) {
  const auto law = make_cohesive_law(Softening::exponential, ft, Gf);
  const MixedMode mode{.strength_ratio = 1.7, .energy_ratio = 3};
  const double a = 4 * law->steepest_slope();
  const auto traction = [&](const Eigen::Vector2d& w) {
    const double d = mode.effective(w);
    return Eigen::Vector2d(law->traction(d) / d * w[0], mode.traction_weight() * law->traction(d) / d * w[1]);
  };
  const NodeResponse<2> r = node_response<2>(*law, mode, a, {}, {3 * ft, 5 * ft});
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
  const NodeHistory<2> broken{.largest = wf, .slip = Slip<2>(slip)};
  for (const double share : {-0.99, 0.0, 0.99}) {
    const NodeResponse<2> held =
        node_response<2>(*law, mode, a, broken, {-pressure, a * slip + share * 0.5 * pressure});
    EXPECT_EQ(held.opening[1], slip);
    EXPECT_FALSE(held.free[1]);
  }
  for (const double side : {1.0, -1.0}) {
    const double p = a * slip + side * 0.7 * pressure;
    const NodeResponse<2> sliding = node_response<2>(*law, mode, a, broken, {-pressure, p});
    EXPECT_EQ(sliding.friction[0], side * 0.5);
    EXPECT_NEAR(p - a * sliding.opening[1], side * 0.5 * pressure,
                1e-9 * pressure); // the remaining traction is that of the Coulomb cone
    EXPECT_GT(side * (sliding.opening[1] - slip), 0);
  }
}

// A node that slid in the last step is on the Coulomb cone up to round-off and must be treated as sliding;
// otherwise the tangent of a converged state would depend on round-off.
TEST(Friction, RoundOffBelowTheConeStillSlides) {
  const auto law = make_cohesive_law(Softening::linear, ft, Gf);
  const MixedMode mode{.friction = 0.5};
  const double a = 3 * law->steepest_slope(), pressure = 10 * ft;
  const NodeHistory<2> broken{.largest = law->final_opening(), .slip = Slip<2>(1e-6)};
  for (const double share : {1 - 1e-12, 1 + 1e-12})
    EXPECT_TRUE(
        node_response<2>(*law, mode, a, broken, {-pressure, a * 1e-6 + share * 0.5 * pressure}).free[1]);
  EXPECT_FALSE(
      node_response<2>(*law, mode, a, broken, {-pressure, a * 1e-6 + 0.999 * 0.5 * pressure}).free[1]);
}

// In 3D shear is a vector. In one plane the response is that of 2D, and it does not depend on the direction
// within the crack.
TEST(NodeIn3D, IsThatOf2DInItsPlaneAndTurnsWithTheShear) {
  const auto law = make_cohesive_law(Softening::exponential, ft, Gf);
  const double a = 3 * law->steepest_slope(), wf = law->final_opening();
  std::mt19937 random(7);
  std::uniform_real_distribution<double> u(-1, 1);
  int sliding = 0, loading = 0;
  for (int i = 0; i < 5000; ++i) {
    const MixedMode mode{.strength_ratio = 1.7, .energy_ratio = 2, .friction = i % 2 ? 0.6 : 0};
    const double largest = std::max(0.0, 1.3 * wf * u(random)), slip = largest * u(random);
    const double normal = 2 * a * wf * u(random), shear = 2 * a * wf * u(random), angle = 3 * u(random);
    const NodeResponse<2> plane =
        node_response<2>(*law, mode, a, {.largest = largest, .slip = Slip<2>(slip)}, {normal, shear});
    const Slip<3> along(std::cos(angle), std::sin(angle));
    const NodeResponse<3> turned = node_response<3>(*law, mode, a, {.largest = largest, .slip = slip * along},
                                                    {normal, shear * along[0], shear * along[1]});
    ASSERT_NEAR(turned.opening[0], plane.opening[0], 1e-12 * wf);
    ASSERT_LE((turned.opening.tail<2>() - plane.opening[1] * along).norm(), 1e-12 * wf);
    ASSERT_LE((turned.friction - plane.friction[0] * along).norm(), 1e-12);
    ASSERT_NEAR(along.dot(turned.tangent.bottomRightCorner<2, 2>() * along), plane.tangent(1, 1), 1e-8 * a);
    ASSERT_EQ(turned.free[1], plane.free[1]);
    ASSERT_EQ(turned.loading, plane.loading);
    sliding += plane.friction[0] != 0;
    loading += plane.loading;
  }
  EXPECT_GT(sliding, 300);
  EXPECT_GT(loading, 300);
}

// While sliding in any direction the friction traction has the size of the Coulomb cone and opposes the slip.
TEST(NodeIn3D, FrictionOpposesTheSlipAtTheSizeOfTheCone) {
  const auto law = make_cohesive_law(Softening::linear, ft, Gf);
  const MixedMode mode{.friction = 0.5};
  const double a = 3 * law->steepest_slope(), wf = law->final_opening(), pressure = 10 * ft;
  const NodeHistory<3> broken{.largest = wf, .slip = {0.3 * wf, -0.1 * wf}};
  for (double angle = 0; angle < 6; angle += 0.5) {
    const Slip<3> shear = a * broken.slip + 0.8 * pressure * Slip<3>(std::cos(angle), std::sin(angle));
    const NodeResponse<3> r = node_response<3>(*law, mode, a, broken, {-pressure, shear[0], shear[1]});
    const Slip<3> carried = shear - a * r.opening.tail<2>(), slipped = r.opening.tail<2>() - broken.slip;
    EXPECT_NEAR(carried.norm(), 0.5 * pressure, 1e-9 * pressure);
    EXPECT_NEAR(carried.dot(slipped), carried.norm() * slipped.norm(),
                1e-9 * carried.norm() * slipped.norm());
  }
}

// The tangent is the derivative of the response: d opening / d augmented = (tangent + augmentation)^-1, also
// where the faces slide in a direction that turns.
TEST(NodeIn3D, TangentIsTheDerivativeOfTheResponse) {
  const auto law = make_cohesive_law(Softening::exponential, ft, Gf);
  const double wf = law->final_opening();
  for (const double friction : {0.0, 0.5})
    for (const double largest : {0.0, 0.3 * wf, wf}) {
      const MixedMode mode{.strength_ratio = 1.3, .energy_ratio = 1.5, .friction = friction};
      const double a = 3 * law->steepest_slope(), weight = mode.traction_weight();
      const NodeHistory<3> history{.largest = largest, .slip = {0.2 * largest, -0.1 * largest}};
      const Opening<3> p(-4 * ft, 9 * ft, 5 * ft);
      const NodeResponse<3> r = node_response<3>(*law, mode, a, history, p);
      ASSERT_TRUE(r.free[1] && r.free[2] && !r.free[0]);
      Eigen::Matrix2d derivative;
      for (int c = 0; c < 2; ++c) {
        const Opening<3> h = 1e-5 * ft * Opening<3>::Unit(c + 1);
        derivative.col(c) = (node_response<3>(*law, mode, a, history, p + h).opening -
                             node_response<3>(*law, mode, a, history, p - h).opening)
                                .tail<2>() /
                            (2e-5 * ft);
      }
      const Eigen::Matrix2d tangent = r.tangent.bottomRightCorner<2, 2>();
      EXPECT_LE(
          ((tangent + weight * a * Eigen::Matrix2d::Identity()) * derivative - Eigen::Matrix2d::Identity())
              .norm(),
          1e-5)
          << friction << " " << largest / wf;
    }
}

} // namespace
