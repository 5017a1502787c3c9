// Tests of the one-dimensional laws of steel and bond.

#include "tests/unit/reinforcement/bars.h"

#include <gtest/gtest.h>

#include <random>

namespace spall::test {
namespace {

TEST(BarSteel, YieldsHardensAndUnloadsElastically) {
  const BarSteel s = steel();
  SteelState state;
  s.advance(state, 1e-3);
  EXPECT_NEAR(state.stress, 200e6, 1);
  const double strain = 0.02; // on the bilinear curve: slope E H / (E + H) beyond the yield point
  for (int n = 1; n <= 100; ++n) s.advance(state, 1e-3 + (strain - 1e-3) * n / 100);
  const double slope = 200e9 * 1e9 / 201e9, stress = 500e6 + slope * (strain - 2.5e-3);
  EXPECT_NEAR(state.stress, stress, 1e-9 * stress);
  EXPECT_NEAR(state.plastic_strain, strain - stress / 200e9, 1e-12);
  s.advance(state, strain - 1e-3);
  EXPECT_NEAR(state.stress, stress - 200e6, 1e-9 * stress);
  s.advance(state, strain - 2.5 * stress / 200e9); // isotropic: it yields at the same stress in compression
  EXPECT_LT(state.stress, -stress);
  EXPECT_GT(state.accumulated, state.plastic_strain);
}

TEST(BarSteel, BreaksWhenThePlasticStrainOfBothDirectionsReachesItsLimit) {
  const BarSteel s = steel(0.01);
  SteelState pulled, cycled;
  s.advance(pulled, 0.0124);
  EXPECT_FALSE(s.ruptured(pulled));
  s.advance(pulled, 0.0127);
  EXPECT_TRUE(s.ruptured(pulled));
  EXPECT_EQ(pulled.stress, 0);
  s.advance(pulled, -1);
  EXPECT_EQ(pulled.stress, 0);
  s.advance(cycled, 0.01);
  s.advance(cycled, 0);
  EXPECT_TRUE(s.ruptured(cycled));
}

TEST(BarSteel, DissipatesOnEveryPath) {
  const BarSteel s = steel();
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> step(-2e-3, 2e-3);
  SteelState state;
  double strain = 0, work = 0, dissipated = 0;
  for (int n = 0; n < 2000; ++n) {
    const double more = step(engine), before = state.stress;
    strain += more;
    s.advance(state, strain);
    work += 0.5 * (before + state.stress) * more;
    const double now = work - 0.5 * state.stress * state.stress / s.youngs_modulus;
    // The mean of the stresses at its ends is not the work of a step that yields in its course.
    EXPECT_GE(now, dissipated - 0.5 * 500e6 * std::abs(more));
    dissipated = now;
  }
  EXPECT_GT(dissipated, 1e8);
}

BondLaw slip_law() {
  return {.kind = BondKind::slip, .stiffness = 60e9, .concrete_strength = 36e6, .rib_spacing = 6e-3};
}

TEST(BondLaw, FollowsTheModelCode) {
  const BondLaw law = slip_law();
  const double most = 15e6; // 2.5 MPa sqrt(36)
  EXPECT_NEAR(law.largest_stress(0), 0, 1);
  EXPECT_NEAR(law.largest_stress(0.1e-3), most * std::pow(0.1, 0.4), 1);
  EXPECT_NEAR(law.largest_stress(1.5e-3), most, 1);
  EXPECT_NEAR(law.largest_stress(4e-3), most * 0.7, 1);
  EXPECT_NEAR(law.largest_stress(0.1), most * 0.4, 1);
  BondState state;
  const double around = std::numbers::pi * diameter;
  double largest = 0;
  for (int n = 0; n < 8000; ++n) {
    law.advance(state, 1e-6, {}, diameter);
    largest = std::max(largest, -state.along);
  }
  EXPECT_NEAR(largest, around * most, 1e-6 * around * most);
  EXPECT_NEAR(-state.along, around * 0.4 * most, 1e-6 * around * most);
  EXPECT_NEAR(state.slip, 8e-3, 1e-12);
  law.advance(state, -1e-8, {}, diameter); // unloads elastically
  EXPECT_NEAR(-state.along, around * 0.4 * most - 600, 1e-3);
}

TEST(BondLaw, BearsNoMoreThanMakesTheStrengthOfADowel) {
  const BondLaw law = slip_law();
  BondState state;
  law.advance(state, 0, {3e-3, 4e-3, 0}, 10e-3);
  EXPECT_NEAR(norm(state.across), 5.07 * 36e6 * 10e-3, 1);
  EXPECT_LT(state.across[0], 0); // against the displacement
  EXPECT_NEAR(state.across[1] / state.across[0], 4. / 3, 1e-12);
  const double q = norm(state.across), yield = 500e6, moment = std::pow(10e-3, 3) / 6 * yield;
  EXPECT_NEAR(std::sqrt(2 * moment * q), 1.3 * std::pow(10e-3, 2) * std::sqrt(yield * 36e6), 1);
}

TEST(BondLaw, ARigidBondIsElasticWithoutLimit) {
  BondLaw law = slip_law();
  law.kind = BondKind::rigid;
  BondState state;
  law.advance(state, 0.1, {0, 0.2, 0}, 10e-3);
  EXPECT_NEAR(state.along, -6e9, 1);
  EXPECT_NEAR(state.across[1], -12e9, 1);
  law.advance(state, -0.1, {0, -0.2, 0}, 10e-3);
  EXPECT_NEAR(state.along, 0, 1e-3);
}

TEST(BondLaw, StiffnessIsThatOfAShaftOfConcreteInShear) {
  EXPECT_NEAR(BondLaw::elastic_stiffness(10e9, 1e-3, 20e-3), 2 * std::numbers::pi * 10e9 / std::log(20), 1);
  EXPECT_NEAR(BondLaw::elastic_stiffness(10e9, 10e-3, 20e-3), 2 * std::numbers::pi * 10e9, 1); // thick
}

} // namespace
} // namespace spall::test
