#pragma once

#include "macro/solid/point_kinematics.h"

#include <random>

namespace spall::test {

/// Random tensors, the same in every run.
class RandomTensors {
public:
  explicit RandomTensors(unsigned seed = 1) : engine(seed) {}
  double number() { return range(engine); }
  Mat3 matrix(double size = 1) {
    Mat3 a;
    for (double& x : a) x = size * number();
    return a;
  }
  /// Returns a deformation near the identity, which inverts no cell.
  Mat3 deformation(double size = 0.3) { return identity3 + matrix(size); }
  Sym3 symmetric(double size = 1) {
    Sym3 s;
    for (double& x : s) x = size * number();
    return s;
  }
  SymLanes<4> lanes(double size = 1) {
    SymLanes<4> s;
    for (auto& component : s)
      component = Lanes<double>{size * number(), size * number(), size * number(), size * number()};
    return s;
  }
  /// Returns a rotation by `angle` about a random axis (Rodrigues' formula).
  Mat3 rotation(double angle) {
    const auto [x, y, z] = unit(Vec3{number(), number(), number()});
    const double s = std::sin(angle), c = std::cos(angle);
    return {c + x * x * (1 - c),     x * y * (1 - c) - z * s, x * z * (1 - c) + y * s,
            y * x * (1 - c) + z * s, c + y * y * (1 - c),     y * z * (1 - c) - x * s,
            z * x * (1 - c) - y * s, z * y * (1 - c) + x * s, c + z * z * (1 - c)};
  }

private:
  std::mt19937 engine;
  std::uniform_real_distribution<double> range{-1, 1};
};

using Rates = MatLanes<4>;

/// Returns the rates of four gradient operators: the first one deforms `start` to `end` in dt, the others are
/// `moments`, if given.
inline Rates rates_between(const Mat3& start, const Mat3& end, double dt,
                           const std::array<Mat3, 3>& moments = {}) {
  Rates rates;
  put_lane<4>(rates, 0, (end - start) / dt);
  for (int m = 1; m < 4; ++m) put_lane<4>(rates, m, moments[m - 1]);
  return rates;
}

/// Returns the kinematics of a step of a node whose own rates are those of its first gradient operator, with
/// which all turn.
inline StepKinematics<double, double, 4> kinematics_of(const Rates& rates, const Mat3& start, double dt) {
  std::array<Mat3, 4> each;
  for (int m = 0; m < 4; ++m) each[m] = lane<4>(rates, m);
  return step_kinematics(each, each[0], start, dt);
}

} // namespace spall::test
