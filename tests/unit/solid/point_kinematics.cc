#include "macro/solid/point_kinematics.h"

#include "tests/unit/solid/samples.h"

#include <gtest/gtest.h>

namespace spall::test {
namespace {

constexpr double dt = 1e-7;

void expect_near(const Mat3& a, const Mat3& b, double tolerance) {
  for (int i = 0; i < 9; ++i) EXPECT_NEAR(a[i], b[i], tolerance) << "component " << i;
}

TEST(StepKinematics, ARotationOfAnySizeIsNoStrainAndIsRecoveredExactly) {
  RandomTensors random;
  for (const double angle : {1e-6, 0.01, 0.5, 2.0}) {
    const Mat3 start = random.deformation(), q = random.rotation(angle);
    const auto k = kinematics_of(rates_between(start, multiply(q, start), dt), start, dt);
    for (int c = 0; c < 6; ++c) EXPECT_NEAR(k.increment[0][c], 0, 1e-14);
    expect_near(k.rotation, q, 1e-14);
    EXPECT_NEAR(k.volume_factor, determinant(start), 1e-14);
  }
}

TEST(StepKinematics, ARotationWithTheVelocityOfItsStartStrainsToSecondOrderOfTheAngleOnly) {
  // x + dt w x x stretches by angle^2 / 2 across the axis: halving the step quarters it.
  double last = 0;
  for (const double angle : {0.04, 0.02, 0.01}) {
    const Mat3 spin = {0, -angle, 0, angle, 0, 0, 0, 0, 0};
    const auto k = kinematics_of(rates_between(identity3, identity3 + spin, dt), identity3, dt);
    const double strain = k.increment[0][0];
    EXPECT_NEAR(strain, angle * angle / 2, angle * angle * angle);
    if (last > 0) {
      EXPECT_NEAR(last / strain, 4, 0.05);
    }
    last = strain;
  }
}

TEST(StepKinematics, TheRotationIsOrthogonalWhateverTheStep) {
  RandomTensors random(2);
  for (int n = 0; n < 50; ++n) {
    const Mat3 start = random.deformation(), end = random.deformation();
    const auto k = kinematics_of(rates_between(start, end, dt), start, dt);
    expect_near(multiply(k.rotation, transpose(k.rotation)), identity3, 1e-13);
    EXPECT_NEAR(determinant(k.rotation), 1, 1e-13);
  }
}

TEST(StepKinematics, StretchesAddUpToTheLogarithmWithThirdOrderError) {
  const double target = 1.5;
  double last = 0;
  for (const int steps : {10, 20, 40}) {
    Mat3 f = identity3;
    double strain = 0, volume = 1;
    for (int i = 0; i < steps; ++i) {
      Mat3 end = f;
      end[0] = std::pow(target, (i + 1.) / steps);
      const auto k = kinematics_of(rates_between(f, end, dt), f, dt);
      strain += k.increment[0][0];
      volume = k.volume_factor;
      f = k.end;
    }
    EXPECT_NEAR(volume, target, 1e-14);
    const double error = std::abs(strain - std::log(target));
    // The error of one step is de^3 / 12, so that of the sum is proportional to the square of the step.
    EXPECT_LT(error, std::pow(std::log(target), 3) / 12 / steps / steps * 1.1);
    if (last > 0) {
      EXPECT_NEAR(last / error, 4, 0.1);
    }
    last = error;
  }
}

TEST(StepKinematics, EndAndFactorsAreThoseOfTheGivenDeformations) {
  RandomTensors random(3);
  const Mat3 start = random.deformation(), end = random.deformation();
  const Mat3 middle = 0.5 * (start + end);
  const auto k = kinematics_of(rates_between(start, end, dt), start, dt);
  expect_near(k.end, end, 1e-15);
  EXPECT_NEAR(k.volume_factor, determinant(end), 1e-14);
  EXPECT_NEAR(k.middle_factor, determinant(middle), 1e-14);
}

TEST(StepKinematics, EveryStrainIsThatOfMidstepTurnedByHalfTheSpin) {
  RandomTensors random(4);
  const Mat3 start = random.deformation(), end = random.deformation();
  const std::array<Mat3, 3> moments = {random.matrix(1 / dt), random.matrix(1 / dt), random.matrix(1 / dt)};
  const auto k = kinematics_of(rates_between(start, end, dt, moments), start, dt);
  const Mat3 inverse_middle = inverse(0.5 * (start + end));
  const Mat3 l0 = multiply(end - start, inverse_middle), half_spin = 0.25 * (l0 - transpose(l0));
  for (int m = 0; m < 4; ++m) {
    const Mat3 l = m == 0 ? l0 : multiply(dt * moments[m - 1], inverse_middle);
    const Mat3 d = full(symmetric_part(l));
    const Sym3 expected = symmetric_part(d + multiply(half_spin, d) - multiply(d, half_spin));
    for (int c = 0; c < 6; ++c) EXPECT_NEAR(k.increment[m][c], expected[c], 1e-13);
  }
}

TEST(TurnSlightly, IsARotationToFirstOrderThatKeepsTheTrace) {
  RandomTensors random(8);
  const Sym3 s = random.symmetric();
  double last = 0;
  for (const double angle : {0.04, 0.02, 0.01}) {
    const Vec3 spin = {0.6 * angle, 0.0, 0.8 * angle};
    const Sym3 turned = turn_slightly(spin, s), rotated = rotate(cayley_rotation(spin), s);
    EXPECT_NEAR(trace(turned), trace(s), 1e-15);
    const double error = largest_component(turned - rotated);
    if (last > 0) {
      EXPECT_NEAR(last / error, 4, 0.2);
    }
    last = error;
  }
}

TEST(StepKinematics, OperatorsWithTheirOwnSpinAreIndependentPoints) {
  RandomTensors random(9);
  const Mat3 start = random.deformation();
  const std::array<Mat3, 3> others = {random.matrix(0.1 / dt), random.matrix(0.1 / dt),
                                      random.matrix(0.1 / dt)};
  const Rates rates = rates_between(start, random.deformation(), dt, others);
  const auto k = step_kinematics(std::array{rates}, lane<4>(rates, 0), start, dt);
  // All operators share the deformation of the first one at midstep.
  const SymLanes<4> stress = random.lanes(), together = rotate(k.rotation, stress);
  const Mat3 inverse_middle = inverse(0.5 * (start + k.end));
  for (int m = 0; m < 4; ++m) {
    const Mat3 l = multiply(dt * lane<4>(rates, m), inverse_middle);
    const Vec3 spin = {0.5 * (l[7] - l[5]), 0.5 * (l[2] - l[6]), 0.5 * (l[3] - l[1])};
    const Sym3 expected = rotate(cayley_rotation(spin), lane<4>(stress, m));
    for (int c = 0; c < 6; ++c) EXPECT_NEAR(together[c][m], expected[c], 1e-14);
  }
}

TEST(StepKinematics, OneOperatorIsTheFirstOfFour) {
  RandomTensors random(10);
  const Mat3 start = random.deformation(), end = random.deformation();
  const Rates rates = rates_between(start, end, dt);
  const auto four = kinematics_of(rates, start, dt);
  const Mat3 first = lane<4>(rates, 0);
  const auto one = step_kinematics(std::array{first}, first, start, dt);
  for (int c = 0; c < 6; ++c) EXPECT_NEAR(one.increment[0][c], four.increment[0][c], 1e-15);
  expect_near(one.rotation, four.rotation, 1e-15);
}

TEST(StepKinematics, NodesSideBySideAreIndependent) {
  RandomTensors random(11);
  std::array<MatLanes<8>, 4> rates;
  MatLanes<8> start;
  for (int n = 0; n < 8; ++n) {
    put_lane<8>(start, n, random.deformation());
    for (MatLanes<8>& rate : rates) put_lane<8>(rate, n, random.matrix(0.1 / dt));
  }
  const auto all = step_kinematics(rates, rates[0], start, dt);
  for (int n = 0; n < 8; ++n) {
    std::array<Mat3, 4> of_node;
    for (std::size_t m = 0; m < 4; ++m) of_node[m] = lane<8>(rates[m], n);
    const auto one = step_kinematics(of_node, of_node[0], lane<8>(start, n), dt);
    for (std::size_t m = 0; m < 4; ++m)
      for (std::size_t c = 0; c < 6; ++c) EXPECT_NEAR(all.increment[m][c][n], one.increment[m][c], 1e-14);
    expect_near(lane<8>(all.rotation, n), one.rotation, 1e-14);
    expect_near(lane<8>(all.end, n), one.end, 1e-14);
    EXPECT_NEAR(all.volume_factor[n], one.volume_factor, 1e-14);
    EXPECT_NEAR(all.middle_factor[n], one.middle_factor, 1e-14);
  }
}

TEST(Rotate, IsQSQTransposedInEveryLaneAndKeepsInvariants) {
  RandomTensors random(5);
  for (int n = 0; n < 20; ++n) {
    const Mat3 q = random.rotation(3 * random.number());
    const SymLanes<4> s = random.lanes(), r = rotate(q, s);
    for (int m = 0; m < 4; ++m) {
      const Sym3 before = lane<4>(s, m), after = lane<4>(r, m);
      const Mat3 expected = multiply(multiply(q, full(before)), transpose(q));
      expect_near(full(after), expected, 1e-14);
      EXPECT_NEAR(trace(after), trace(before), 1e-14);
      EXPECT_NEAR(contract(after, after), contract(before, before), 1e-13);
      EXPECT_NEAR(determinant(full(after)), determinant(full(before)), 1e-13);
    }
  }
}

TEST(NominalStress, IsTheFactorTimesStressTimesInverseTransposeInEveryLane) {
  RandomTensors random(6);
  const Mat3 f = random.deformation();
  const SymLanes<4> s = random.lanes();
  const auto p = nominal_stress(s, f, -2.5);
  for (int m = 0; m < 4; ++m) {
    const Mat3 expected = multiply(full(lane<4>(s, m)), transpose(inverse(f)));
    for (int c = 0; c < 3; ++c)
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(p(i, c)[m], -2.5 * expected(c, i), 1e-13);
  }
}

TEST(NominalStress, DoesTheWorkOfTheCauchyStress) {
  // P : dF = J sigma : (dF F^-1) for any dF.
  RandomTensors random(7);
  const Mat3 f = random.deformation(), change = random.matrix();
  const SymLanes<4> s = random.lanes();
  const auto p = nominal_stress(s, f, determinant(f));
  double work = 0;
  for (int c = 0; c < 3; ++c)
    for (int i = 0; i < 3; ++i) work += p(i, c)[0] * change(c, i);
  EXPECT_NEAR(work, determinant(f) * contract(lane<4>(s, 0), symmetric_part(multiply(change, inverse(f)))),
              1e-13);
}

} // namespace
} // namespace spall::test
