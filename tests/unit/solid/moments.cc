// Tests of the rate law of the stress moments (stabilisation).

#include "macro/solid/point_kinematics.h"
#include "tests/unit/solid/samples.h"

#include <gtest/gtest.h>

#include <limits>

namespace spall::test {
namespace {

Stiffness plastic_tangent(RandomTensors& random) {
  Stiffness tangent{.bulk = 22e9, .shear = 7e9, .flow = 6e9};
  tangent.direction = deviator(random.symmetric());
  tangent.direction /= std::sqrt(contract(tangent.direction, tangent.direction));
  return tangent;
}

TEST(Moments, GrowByTheWeightTimesTheTangentOfTheirOwnStrain) {
  RandomTensors random;
  const Stiffness tangent = plastic_tangent(random);
  const double weight = 0.05;
  const Sym3 before = random.symmetric(1e6), increment = random.symmetric(1e-3);
  const Sym3 after = advance_moment(before, increment, tangent, weight), expected = tangent(increment);
  for (int c = 0; c < 6; ++c) EXPECT_NEAR(after[c] - before[c], weight * expected[c], 1e-3);
}

TEST(Moments, DoNotResistFlowAlongThePlasticDirectionOfPerfectPlasticity) {
  RandomTensors random(2);
  Stiffness tangent = plastic_tangent(random);
  tangent.flow = tangent.shear;
  const Sym3 stress = advance_moment(Sym3{}, 1e-3 * tangent.direction, tangent, 1);
  for (int c = 0; c < 6; ++c) EXPECT_NEAR(stress[c], 0, 1e-6);
}

TEST(Moments, AreHeldBelowTheLimitWithoutChangingTheirDirection) {
  RandomTensors random(3);
  Stiffness tangent{.bulk = 22e9, .shear = 7e9};
  tangent.limit = 1e6;
  for (const double size : {1e5, 1e7}) {
    const Sym3 b = random.symmetric(size), a = advance_moment(b, Sym3{}, tangent, 1);
    const Sym3 sa = deviator(a), sb = deviator(b);
    EXPECT_LE(equivalent_stress(sa), tangent.limit * (1 + 1e-12));
    EXPECT_LE(std::abs(trace(a) / 3), tangent.limit * (1 + 1e-12));
    const double return_factor = std::min(1.0, tangent.limit / equivalent_stress(sb));
    for (int c = 0; c < 6; ++c) EXPECT_NEAR(sa[c], return_factor * sb[c], 1e-9 * size);
  }
}

TEST(Moments, OfAMaterialThatKeepsItsStrengthAreNotLimited) {
  const Stiffness tangent{.bulk = 22e9, .shear = 7e9};
  RandomTensors random(4);
  const Sym3 before = random.symmetric(1e12), after = advance_moment(before, Sym3{}, tangent, 1);
  for (int c = 0; c < 6; ++c) EXPECT_EQ(after[c], before[c]);
}

/// One of the points side by side may have lost its strength, another keeps it.
TEST(Moments, SideBySideHaveEachTheirOwnLimit) {
  RandomTensors random(5);
  const SymLanes<4> before = random.lanes(1e7), increment = random.lanes(1e-4);
  StiffnessOf<Lanes<double>> tangent;
  tangent.bulk = broadcast<Lanes<double>>(22e9), tangent.shear = broadcast<Lanes<double>>(7e9);
  tangent.limit = Lanes<double>{1e6, std::numeric_limits<double>::infinity(), 0, 1e9};
  const SymLanes<4> after = advance_moment(before, increment, tangent, 1);
  for (int m = 0; m < 4; ++m) {
    const Stiffness one{.bulk = 22e9, .shear = 7e9, .limit = tangent.limit[m]};
    const Sym3 alone = advance_moment(lane<4>(before, m), lane<4>(increment, m), one, 1);
    for (int c = 0; c < 6; ++c) EXPECT_NEAR(after[c][m], alone[c], 1e-8 * 1e7) << m;
  }
}

} // namespace
} // namespace spall::test
