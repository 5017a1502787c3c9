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
    const auto k = kinematics_of<4>(rates_between(start, multiply(q, start), dt), start, dt);
    for (int c = 0; c < 6; ++c) EXPECT_NEAR(k.increment[c][0], 0, 1e-14);
    expect_near(k.rotation, q, 1e-14);
    EXPECT_NEAR(k.volume_factor, determinant(start), 1e-14);
  }
}

TEST(StepKinematics, ARotationWithTheVelocityOfItsStartStrainsToSecondOrderOfTheAngleOnly) {
  // x + dt w x x stretches by angle^2 / 2 across the axis: halving the step quarters it.
  double last = 0;
  for (const double angle : {0.04, 0.02, 0.01}) {
    const Mat3 spin = {0, -angle, 0, angle, 0, 0, 0, 0, 0};
    Mat3 end = identity3;
    for (int i = 0; i < 9; ++i) end[i] += spin[i];
    const auto k = kinematics_of<4>(rates_between(identity3, end, dt), identity3, dt);
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
    const auto k = kinematics_of<4>(rates_between(start, end, dt), start, dt);
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
      const auto k = kinematics_of<4>(rates_between(f, end, dt), f, dt);
      strain += k.increment[0][0];
      volume = k.volume_factor;
      f = k.end;
    }
    EXPECT_NEAR(volume, target, 1e-14);
    const double error = std::abs(strain - std::log(target));
    // One step errs by de^3 / 12, the sum by the square of the step.
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
  Mat3 middle;
  for (int i = 0; i < 9; ++i) middle[i] = 0.5 * (start[i] + end[i]);
  const auto k = kinematics_of<4>(rates_between(start, end, dt), start, dt);
  expect_near(k.end, end, 1e-15);
  EXPECT_NEAR(k.volume_factor, determinant(end), 1e-14);
  EXPECT_NEAR(k.middle_factor, determinant(middle), 1e-14);
}

TEST(StepKinematics, EveryLaneIsTheStrainOfMidstepTurnedByHalfTheSpin) {
  RandomTensors random(4);
  const Mat3 start = random.deformation(), end = random.deformation();
  const std::array<Mat3, 3> moments = {random.matrix(1 / dt), random.matrix(1 / dt), random.matrix(1 / dt)};
  const auto k = kinematics_of<4>(rates_between(start, end, dt, moments), start, dt);
  Mat3 middle, change, spin;
  for (int i = 0; i < 9; ++i) middle[i] = 0.5 * (start[i] + end[i]), change[i] = end[i] - start[i];
  for (int m = 0; m < 4; ++m) {
    if (m > 0)
      for (int i = 0; i < 9; ++i) change[i] = moments[m - 1][i] * dt;
    const Mat3 l = multiply(change, inverse(middle));
    Sym3 expected = symmetric_part(l);
    if (m == 0) {
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) spin[3 * i + j] = 0.25 * (l[3 * i + j] - l[3 * j + i]); // half a step's
    }
    const Mat3 d = full(expected), wd = multiply(spin, d), dw = multiply(d, spin);
    Mat3 turned;
    for (int i = 0; i < 9; ++i) turned[i] = d[i] + wd[i] - dw[i];
    expected = symmetric_part(turned);
    for (int c = 0; c < 6; ++c) EXPECT_NEAR(k.increment[c][m], expected[c], 1e-13);
  }
}

TEST(TurnSlightly, IsARotationToFirstOrderThatKeepsTheTrace) {
  RandomTensors random(8);
  const Sym3 s = random.symmetric();
  double last = 0;
  for (const double angle : {0.04, 0.02, 0.01}) {
    const Sym3 turned = turn_slightly(0.6 * angle, 0.0, 0.8 * angle, s),
               rotated = rotate(cayley_rotation(0.6 * angle, 0.0, 0.8 * angle), s);
    EXPECT_NEAR(trace(turned), trace(s), 1e-15);
    double error = 0;
    for (int c = 0; c < 6; ++c) error = std::max(error, std::abs(turned[c] - rotated[c]));
    if (last > 0) {
      EXPECT_NEAR(last / error, 4, 0.2);
    }
    last = error;
  }
}

TEST(StepKinematics, LanesThatTurnByTheirOwnSpinAreEachTheirOwnPoint) {
  RandomTensors random(9);
  const Mat3 start = random.deformation();
  const std::array<Mat3, 3> others = {random.matrix(0.1 / dt), random.matrix(0.1 / dt),
                                      random.matrix(0.1 / dt)};
  const Rates rates = rates_between(start, random.deformation(), dt, others);
  const auto k = kinematics_of<4, Lanes<double>>(rates, start, dt);
  // Lanes 1-3 as lane 0, with the same deformation at midstep: that of lane 0.
  const SymLanes<4> stress = random.lanes(), together = rotate(k.rotation, stress);
  const Mat3 inverse_middle = inverse([&] {
    Mat3 m;
    for (int i = 0; i < 9; ++i) m[i] = 0.5 * (start[i] + k.end[i]);
    return m;
  }());
  for (int m = 0; m < 4; ++m) {
    Mat3 change;
    for (int i = 0; i < 9; ++i) change[i] = rates[i / 3][i % 3][m] * dt;
    const Mat3 l = multiply(change, inverse_middle);
    const Mat3 q = cayley_rotation(0.5 * (l[7] - l[5]), 0.5 * (l[2] - l[6]), 0.5 * (l[3] - l[1]));
    const Sym3 expected = rotate(q, lane(stress, m));
    for (int c = 0; c < 6; ++c) EXPECT_NEAR(together[c][m], expected[c], 1e-14);
  }
}

TEST(StepKinematics, OneLaneIsTheFirstOfFour) {
  RandomTensors random(10);
  const Mat3 start = random.deformation(), end = random.deformation();
  const Rates rates = rates_between(start, end, dt);
  MatLanes<1> first;
  for (int c = 0; c < 3; ++c)
    for (int i = 0; i < 3; ++i) first[c][i] = rates[c][i][0];
  const auto four = kinematics_of<4>(rates, start, dt);
  const auto one = kinematics_of<1>(first, start, dt);
  for (int c = 0; c < 6; ++c) EXPECT_NEAR(one.increment[c], four.increment[c][0], 1e-15);
  expect_near(one.rotation, four.rotation, 1e-15);
}

TEST(Rotate, IsQSQTransposedInEveryLaneAndKeepsInvariants) {
  RandomTensors random(5);
  for (int n = 0; n < 20; ++n) {
    const Mat3 q = random.rotation(3 * random.number());
    const SymLanes<4> s = random.lanes(), r = rotate(q, s);
    for (int m = 0; m < 4; ++m) {
      const Sym3 before = lane(s, m), after = lane(r, m);
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
  const auto p = nominal_stress<4>(s, f, -2.5);
  for (int m = 0; m < 4; ++m) {
    const Mat3 expected = multiply(full(lane(s, m)), transpose(inverse(f)));
    for (int c = 0; c < 3; ++c)
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(p[i][c][m], -2.5 * expected[3 * c + i], 1e-13);
  }
}

TEST(NominalStress, DoesTheWorkOfTheCauchyStress) {
  // P : dF = J sigma : (dF F^-1) for any dF.
  RandomTensors random(7);
  const Mat3 f = random.deformation(), change = random.matrix();
  const SymLanes<4> s = random.lanes();
  const auto p = nominal_stress<4>(s, f, determinant(f));
  double work = 0;
  for (int c = 0; c < 3; ++c)
    for (int i = 0; i < 3; ++i) work += p[i][c][0] * change[3 * c + i];
  EXPECT_NEAR(work, determinant(f) * contract(lane(s, 0), symmetric_part(multiply(change, inverse(f)))),
              1e-13);
}

} // namespace
} // namespace spall::test
