// Tests of the rate law of the stress moments (stabilisation).

#include "macro/solid/point_kinematics.h"
#include "tests/unit/solid/samples.h"

#include <gtest/gtest.h>

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
  const SymLanes<4> before = random.lanes(1e6), increment = random.lanes(1e-3);
  SymLanes<4> after = before;
  add_moment_increment<4>(after, increment, tangent, weight);
  for (int m = 1; m < 4; ++m) {
    const Sym3 expected = tangent(lane<4>(increment, m));
    for (int c = 0; c < 6; ++c) EXPECT_NEAR(after[c][m] - before[c][m], weight * expected[c], 1e-3);
  }
}

TEST(Moments, DoNotResistFlowAlongThePlasticDirectionOfPerfectPlasticity) {
  RandomTensors random(2);
  Stiffness tangent = plastic_tangent(random);
  tangent.flow = tangent.shear;
  SymLanes<4> stress{}, increment;
  for (int c = 0; c < 6; ++c) increment[c] = Lanes<double>{} + 1e-3 * tangent.direction[c];
  add_moment_increment<4>(stress, increment, tangent, 1);
  for (int m = 1; m < 4; ++m)
    for (int c = 0; c < 6; ++c) EXPECT_NEAR(stress[c][m], 0, 1e-6);
}

TEST(Moments, AreHeldBelowTheLimitWithoutChangingTheirDirection) {
  RandomTensors random(3);
  Stiffness tangent{.bulk = 22e9, .shear = 7e9};
  tangent.limit = 1e6;
  for (const double size : {1e5, 1e7}) {
    const SymLanes<4> before = random.lanes(size);
    SymLanes<4> after = before;
    add_moment_increment<4>(after, SymLanes<4>{}, tangent, 1);
    for (int m = 1; m < 4; ++m) {
      const Sym3 a = lane<4>(after, m), b = lane<4>(before, m), sa = deviator(a), sb = deviator(b);
      EXPECT_LE(equivalent_stress(sa), tangent.limit * (1 + 1e-12));
      EXPECT_LE(std::abs(trace(a) / 3), tangent.limit * (1 + 1e-12));
      const double return_factor = std::min(1.0, tangent.limit / equivalent_stress(sb));
      for (int c = 0; c < 6; ++c) EXPECT_NEAR(sa[c], return_factor * sb[c], 1e-9 * size);
    }
  }
}

TEST(Moments, OfAMaterialThatKeepsItsStrengthAreNotLimited) {
  const Stiffness tangent{.bulk = 22e9, .shear = 7e9};
  RandomTensors random(4);
  const SymLanes<4> before = random.lanes(1e12);
  SymLanes<4> after = before;
  add_moment_increment<4>(after, SymLanes<4>{}, tangent, 1);
  for (int c = 0; c < 6; ++c)
    for (int m = 0; m < 4; ++m) EXPECT_EQ(after[c][m], before[c][m]);
}

} // namespace
} // namespace spall::test
