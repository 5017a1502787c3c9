#include "tests/unit/material/samples.h"

#include <gtest/gtest.h>

namespace spall::test {
namespace {

constexpr double dt = 1e-6;

TEST(J2, UniaxialStressWithHardeningFollowsTheClosedForm) {
  const J2 steel = metal("steel_4340");
  const double E = steel.youngs_modulus, H = steel.hardening_modulus, yield = steel.initial_yield;
  for (const double sign : {1., -1.}) {
    SinglePoint point(steel);
    for (int step = 1; step <= 100; ++step) {
      point.advance_with_free_sides(sign * 5e-4, dt);
      const double e = step * 5e-4;
      const double closed = E * e < yield ? E * e : yield + E * H / (E + H) * (e - yield / E);
      EXPECT_NEAR(point.stress[0], sign * closed, 1e-8 * yield);
      EXPECT_NEAR(point.state.plastic_strain, e - closed / E, 1e-10);
    }
  }
}

TEST(J2, SimpleShearFollowsTheClosedForm) {
  const J2 steel = metal("steel_4340");
  const double G = steel.shear_modulus(), H = steel.hardening_modulus, yield = steel.initial_yield;
  SinglePoint point(steel);
  for (int step = 1; step <= 50; ++step) {
    point.advance({0, 0, 0, 1e-3, 0, 0}, dt);
    // tau sqrt(3) = yield + H p with p = 2 / sqrt(3) (exy - tau / 2G)
    const double e = step * 1e-3, r3 = std::sqrt(3.);
    const double closed = 2 * G * e * r3 < yield ? 2 * G * e : (yield + 2 * H * e / r3) / (r3 + H / (r3 * G));
    EXPECT_NEAR(point.stress[3], closed, 1e-10 * yield);
  }
}

TEST(J2, ReturnEndsOnTheYieldSurface) {
  for (const char* name : {"steel_4340", "aluminium_6061_t6", "copper"}) {
    const J2 m = metal(name);
    SinglePoint point(m);
    RandomStrain strain(2e-2);
    for (int step = 0; step < 200; ++step) {
      const double before = point.state.plastic_strain;
      point.advance(strain(), dt);
      const double q = equivalent_stress(deviator(point.stress)), yield = m.yield_stress(point.state);
      if (point.state.plastic_strain > before)
        EXPECT_NEAR(q, yield, 1e-12 * yield);
      else
        EXPECT_LE(q, yield);
    }
    EXPECT_GT(point.state.plastic_strain, 0.1);
  }
}

TEST(J2, RotatedPathGivesRotatedStress) {
  const J2 m = metal("steel_4340");
  const Mat3 r = rotation();
  SinglePoint point(m), rotated(m);
  RandomStrain strain(5e-3);
  for (int step = 0; step < 50; ++step) {
    const Sym3 e = strain();
    point.advance(e, dt);
    rotated.advance(rotate(r, e), dt);
  }
  const Sym3 expected = rotate(r, point.stress);
  EXPECT_SAME_STRESS(rotated.stress, expected, 1e-10 * m.initial_yield);
  EXPECT_NEAR(rotated.state.plastic_strain, point.state.plastic_strain, 1e-12);
}

TEST(J2, PointsSideBySideDoWhatEachDoesAlone) {
  using V = Lanes<double, 8>;
  const J2 m = metal("steel_4340");
  std::array<Sym3, 8> stress_alone{};
  std::array<J2::State, 8> state_alone{};
  Sym<V> stress{};
  J2::StateOf<V> state;
  const Mat<V> deformation = identity_of<V>();
  RandomStrain strain(1);
  int flowed = 0, together = 0;
  for (int n = 0; n < 100; ++n) {
    StrainStepOf<V, V> step{{}, dt, broadcast<V>(1), deformation};
    StiffnessOf<V> tangent;
    std::array<Stiffness, 8> alone;
    int flowing = 0;
    for (int p = 0; p < 8; ++p) {
      const Sym3 e = 1e-3 * (p + 1) * strain(); // some flow, some do not
      put_lane<8>(step.increment, p, e);
      alone[p] = m.update(stress_alone[p], state_alone[p], {e, dt, 1, identity3});
      flowing += alone[p].flow > 0;
    }
    flowed += flowing, together += flowing == 8;
    tangent = m.update(stress, state, step);
    for (int p = 0; p < 8; ++p) {
      EXPECT_SAME_STRESS(lane<8>(stress, p), stress_alone[p], 1e-12 * m.youngs_modulus);
      EXPECT_NEAR(state.plastic_strain[p], state_alone[p].plastic_strain, 1e-12);
      EXPECT_NEAR(tangent.bulk[p], alone[p].bulk, 1e-12 * alone[p].bulk);
      EXPECT_NEAR(tangent.shear[p], alone[p].shear, 1e-9 * m.youngs_modulus);
      EXPECT_NEAR(tangent.flow[p], alone[p].flow, 1e-9 * m.youngs_modulus);
      EXPECT_SAME_STRESS(lane<8>(tangent.direction, p), alone[p].direction, 1e-9);
    }
  }
  EXPECT_GT(flowed, 100);
  EXPECT_LT(together, 100);
}

TEST(J2, TangentIsTheDerivativeOfTheUpdate) {
  for (const char* name : {"steel_4340", "aluminium_6061_t6"}) {
    const J2 m = metal(name);
    SinglePoint point(m);
    RandomStrain strain(1e-2);
    for (int step = 0; step < 20; ++step) point.advance(strain(), dt);
    for (const double size : {1e-4, 2e-2}) { // small steps may unload or be plastic, large ones are plastic
      Sym3 e = strain();
      for (double& x : e) x *= size / 1e-2;
      Sym3 stress = point.stress;
      J2::State state = point.state;
      const Stiffness tangent = m.update(stress, state, {e, dt, 1, identity3});
      for (int k = 0; k < 6; ++k) {
        constexpr double h = 1e-7;
        const auto at = [&](double shift) {
          Sym3 f = e, result = point.stress;
          f[k] += shift;
          J2::State s = point.state;
          m.update(result, s, {f, dt, 1, identity3});
          return result;
        };
        const Sym3 up = at(h), down = at(-h);
        Sym3 direction{}, difference;
        direction[k] = 1;
        for (int i = 0; i < 6; ++i) difference[i] = (up[i] - down[i]) / (2 * h);
        EXPECT_SAME_STRESS(tangent(direction), difference, 1e-5 * m.youngs_modulus);
      }
    }
  }
}

TEST(J2, TangentAlongTheFlowIsTheHardeningTangent) {
  const J2 m = metal("steel_4340");
  const double G = m.shear_modulus(), H = m.hardening_modulus;
  Sym3 stress{};
  J2::State state;
  const Stiffness t = m.update(stress, state, {{0, 0, 0, 0.02, 0, 0}, dt, 1, identity3});
  EXPECT_NEAR(contract(t.direction, t.direction), 1, 1e-12);
  EXPECT_NEAR(contract(t.direction, t(t.direction)), 2 * G * H / (3 * G + H), 1e-10 * G);
}

TEST(J2, ElasticCycleDissipatesNothingAndPlasticFlowNeverCreatesEnergy) {
  const J2 m = metal("steel_4340");
  SinglePoint elastic(m);
  RandomStrain small(3e-5);
  for (int step = 0; step < 100; ++step) elastic.advance(small(), dt);
  ASSERT_EQ(elastic.state.plastic_strain, 0);
  const double peak = elastic.work;
  Sym3 back;
  for (int i = 0; i < 6; ++i) back[i] = -elastic.strain[i];
  elastic.advance(back, dt);
  EXPECT_GT(peak, 0);
  EXPECT_NEAR(elastic.work, 0, 1e-12 * peak);

  SinglePoint point(m);
  RandomStrain strain(1e-3);
  double dissipated = 0;
  for (int step = 0; step < 5000; ++step) {
    point.advance(strain(), dt);
    const double now = point.work - m.stored_energy(point.stress, point.state).total();
    EXPECT_GE(now, dissipated - 1e-9 * (1 + point.work));
    dissipated = now;
  }
  EXPECT_GT(dissipated, 0.9 * m.initial_yield * point.state.plastic_strain);
}

TEST(J2, SoundSpeedIsThatOfUniaxialStrain) {
  const J2 m = metal("aluminium_6061_t6");
  SinglePoint point(m);
  point.advance({1e-6, 0, 0, 0, 0, 0}, dt);
  EXPECT_NEAR(m.sound_speed(point.state), std::sqrt(point.stress[0] / 1e-6 / m.density), 1e-6);
}

} // namespace
} // namespace spall::test
