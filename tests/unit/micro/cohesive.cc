#include "micro/cohesive/linear_softening.h"
#include "micro/cohesive/node_response.h"

#include <gtest/gtest.h>

#include <random>

namespace {

using namespace spall;

constexpr double ft = 3e6, Gf = 80;
const LinearSoftening law(ft, Gf);
const double wf = law.final_opening();

/// Returns the traction of the law itself, without augmentation, for a given history.
Eigen::Vector2d traction(const Eigen::Vector2d& opening, double largest) {
  const double reached = std::max(largest, opening.norm());
  return secant_stiffness(law, reached) * opening;
}

TEST(LinearSoftening, AreaUnderTheCurveIsTheFractureEnergy) {
  EXPECT_DOUBLE_EQ(law.traction(0), ft);
  EXPECT_NEAR(law.traction(wf), 0, 1e-9 * ft);
  EXPECT_NEAR(law.work(wf), Gf, 1e-12 * Gf);
  double area = 0;
  const int steps = 1000;
  for (int i = 0; i < steps; ++i)
    area += 0.5 * wf / steps * (law.traction(wf * i / steps) + law.traction(wf * (i + 1) / steps));
  EXPECT_NEAR(area, Gf, 1e-10 * Gf);
  EXPECT_NEAR((law.traction(0.3 * wf + 1e-9) - law.traction(0.3 * wf - 1e-9)) / 2e-9, law.slope(0.3 * wf),
              1e-6 * law.steepest_slope());
}

TEST(LinearSoftening, DissipationGrowsFromZeroToTheFractureEnergy) {
  EXPECT_DOUBLE_EQ(law.dissipation(0), 0);
  double last = 0;
  for (double opening = 0.1 * wf; opening < wf; opening += 0.1 * wf) {
    EXPECT_GT(law.dissipation(opening), last);
    last = law.dissipation(opening);
  }
  EXPECT_NEAR(law.dissipation(wf), Gf, 1e-12 * Gf);
  EXPECT_NEAR(law.dissipation(5 * wf), Gf, 1e-12 * Gf);
}

TEST(NodeResponse, ClosedAndRigidUpToTheStrength) {
  const double augmentation = 10 * law.steepest_slope();
  for (const Eigen::Vector2d& p :
       {Eigen::Vector2d(0.999 * ft, 0), Eigen::Vector2d(0, -0.999 * ft), Eigen::Vector2d(0.6 * ft, 0.6 * ft),
        Eigen::Vector2d(-50 * ft, 0.9 * ft)}) {
    const NodeResponse<2> r = node_response<2>(law, {}, augmentation, {.largest = 0}, p);
    EXPECT_EQ(r.opening.norm(), 0);
    EXPECT_FALSE(r.free[0] || r.free[1]);
  }
  EXPECT_GT(node_response<2>(law, {}, augmentation, {.largest = 0}, {1.001 * ft, 0}).opening[0], 0);
}

TEST(NodeResponse, NeverInterpenetratesAndSlidesFreelyWhenBroken) {
  const NodeResponse<2> r = node_response<2>(law, {}, 2e12, {.largest = wf}, {-1e8, 3e6});
  EXPECT_EQ(r.opening[0], 0);
  EXPECT_FALSE(r.free[0]);
  EXPECT_NEAR(r.opening[1], 3e6 / 2e12, 1e-18);
  EXPECT_EQ(r.tangent(1, 1), 0);
}

// The response must satisfy p = T(w) + augmentation w and the complementarity of contact, for any history and
// traction.
TEST(NodeResponse, InvertsTheLawExactly) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> u(0, 1);
  int opened = 0, contact = 0, unloading = 0;
  for (int i = 0; i < 20000; ++i) {
    const double augmentation = law.steepest_slope() * (2 + 100 * u(random));
    const double largest = u(random) < 0.3 ? 0 : 1.2 * wf * u(random);
    const double scale = ft + 1.5 * augmentation * wf * u(random) * u(random);
    const Eigen::Vector2d p(scale * (2 * u(random) - 1), scale * (2 * u(random) - 1));
    const NodeResponse<2> r = node_response<2>(law, {}, augmentation, {.largest = largest}, p);
    ASSERT_GE(r.opening[0], 0);
    if (r.opening.norm() == 0) continue;
    const Eigen::Vector2d error = traction(r.opening, largest) + augmentation * r.opening - p;
    if (p[0] <= 0) {
      ++contact;
      ASSERT_EQ(r.opening[0], 0);
      ASSERT_GE(error[0], 0) << "the contact reaction must not be tensile";
    } else {
      ++opened;
      ASSERT_NEAR(error[0], 0, 1e-9 * (ft + p.norm()));
    }
    ASSERT_NEAR(error[1], 0, 1e-9 * (ft + p.norm()));
    unloading += r.opening.norm() < largest;
  }
  EXPECT_GT(opened, 1000);
  EXPECT_GT(contact, 1000);
  EXPECT_GT(unloading, 1000);
}

TEST(NodeResponse, TangentIsTheDerivativeOfTheTraction) {
  const double augmentation = 20 * law.steepest_slope();
  for (const double largest : {0.0, 0.5 * wf, 1.1 * wf})
    for (const Eigen::Vector2d& p :
         {Eigen::Vector2d(4 * ft, 2 * ft), Eigen::Vector2d(12 * ft, -3 * ft), Eigen::Vector2d(-ft, 8 * ft)}) {
      const NodeResponse<2> r = node_response<2>(law, {}, augmentation, {.largest = largest}, p);
      for (int c = 0; c < 2; ++c) {
        if (!r.free[c]) continue;
        const double step = 1e-6 * wf;
        const Eigen::Vector2d plus = r.opening + step * Eigen::Vector2d::Unit(c);
        const Eigen::Vector2d minus = r.opening - step * Eigen::Vector2d::Unit(c);
        const Eigen::Vector2d difference = (traction(plus, largest) - traction(minus, largest)) / (2 * step);
        for (int row = 0; row < 2; ++row) {
          if (r.free[row]) {
            EXPECT_NEAR(r.tangent(row, c), difference[row], 1e-4 * augmentation);
          }
        }
      }
    }
}

// After a converged step a damaged node is at its threshold up to round-off and must be treated as loading.
TEST(NodeResponse, RoundOffBelowTheThresholdStillLoads) {
  const double augmentation = 20 * law.steepest_slope(), largest = 0.4 * wf;
  const double threshold = law.traction(largest) + augmentation * largest;
  EXPECT_LT(node_response<2>(law, {}, augmentation, {.largest = largest}, {threshold * (1 - 1e-12), 0})
                .tangent(0, 0),
            0);
  EXPECT_GT(node_response<2>(law, {}, augmentation, {.largest = largest}, {threshold * (1 - 1e-6), 0})
                .tangent(0, 0),
            0);
}

} // namespace
