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
  /// Near the identity: a deformation that no cell inverts under.
  Mat3 deformation(double size = 0.3) {
    Mat3 a = matrix(size);
    for (int i = 0; i < 9; ++i) a[i] += identity3[i];
    return a;
  }
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
  /// A rotation by `angle` about a random axis (Rodrigues).
  Mat3 rotation(double angle) {
    double x = number(), y = number(), z = number();
    const double n = std::sqrt(x * x + y * y + z * z), s = std::sin(angle), c = std::cos(angle);
    x /= n, y /= n, z /= n;
    return {c + x * x * (1 - c),     x * y * (1 - c) - z * s, x * z * (1 - c) + y * s,
            y * x * (1 - c) + z * s, c + y * y * (1 - c),     y * z * (1 - c) - x * s,
            z * x * (1 - c) - y * s, z * y * (1 - c) + x * s, c + z * z * (1 - c)};
  }

private:
  std::mt19937 engine;
  std::uniform_real_distribution<double> range{-1, 1};
};

using Rates = MatLanes<4>;

/// The rates of lane 0 that take `start` to `end` in dt; lanes 1-3 hold `moments`, if any.
inline Rates rates_between(const Mat3& start, const Mat3& end, double dt,
                           const std::array<Mat3, 3>& moments = {}) {
  Rates rates;
  for (int c = 0; c < 3; ++c)
    for (int i = 0; i < 3; ++i) {
      const int k = 3 * c + i;
      rates[c][i] = Lanes<double>{(end[k] - start[k]) / dt, moments[0][k], moments[1][k], moments[2][k]};
    }
  return rates;
}

/// The step of a node whose own rates are those of lane 0.
template<int L, class Spin = double>
StepKinematics<L, Spin> kinematics_of(const MatLanes<L>& rates, const Mat3& start, double dt) {
  Mat3 node;
  for (int c = 0; c < 9; ++c) node[c] = get_lane<L, double>(rates[c / 3][c % 3], 0);
  return step_kinematics<L, Spin>(rates, node, start, dt);
}

inline Sym3 lane(const SymLanes<4>& s, int m) {
  return {s[0][m], s[1][m], s[2][m], s[3][m], s[4][m], s[5][m]};
}

inline Mat3 full(const Sym3& s) { return {s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2]}; }

} // namespace spall::test
