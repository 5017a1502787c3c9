#pragma once

#include <array>
#include <cmath>

namespace spall {

/// Symmetric second-order tensor in the order xx, yy, zz, xy, yz, xz (tensor components: shear is not
/// doubled).
using Sym3 = std::array<double, 6>;
/// General second-order tensor, row by row.
using Mat3 = std::array<double, 9>;

inline constexpr Mat3 identity3 = {1, 0, 0, 0, 1, 0, 0, 0, 1};

inline double trace(const Sym3& a) { return a[0] + a[1] + a[2]; }

/// a : b
inline double contract(const Sym3& a, const Sym3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + 2 * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5]);
}

inline Sym3 deviator(Sym3 a) {
  const double mean = trace(a) / 3;
  a[0] -= mean, a[1] -= mean, a[2] -= mean;
  return a;
}

/// Equivalent (von Mises) stress of a deviator: sqrt(3/2 s : s).
inline double equivalent_stress(const Sym3& s) { return std::sqrt(1.5 * contract(s, s)); }

inline double determinant(const Mat3& a) {
  return a[0] * (a[4] * a[8] - a[5] * a[7]) - a[1] * (a[3] * a[8] - a[5] * a[6]) +
         a[2] * (a[3] * a[7] - a[4] * a[6]);
}

inline Mat3 multiply(const Mat3& a, const Mat3& b) {
  Mat3 c{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      c[3 * i + j] = a[3 * i] * b[j] + a[3 * i + 1] * b[3 + j] + a[3 * i + 2] * b[6 + j];
  return c;
}

inline Mat3 inverse(const Mat3& a) {
  const double d = 1 / determinant(a);
  return {(a[4] * a[8] - a[5] * a[7]) * d, (a[2] * a[7] - a[1] * a[8]) * d, (a[1] * a[5] - a[2] * a[4]) * d,
          (a[5] * a[6] - a[3] * a[8]) * d, (a[0] * a[8] - a[2] * a[6]) * d, (a[2] * a[3] - a[0] * a[5]) * d,
          (a[3] * a[7] - a[4] * a[6]) * d, (a[1] * a[6] - a[0] * a[7]) * d, (a[0] * a[4] - a[1] * a[3]) * d};
}

inline Mat3 transpose(const Mat3& a) { return {a[0], a[3], a[6], a[1], a[4], a[7], a[2], a[5], a[8]}; }

/// a a^T
inline Sym3 times_transpose(const Mat3& a) {
  const auto row = [&a](int i, int j) {
    return a[3 * i] * a[3 * j] + a[3 * i + 1] * a[3 * j + 1] + a[3 * i + 2] * a[3 * j + 2];
  };
  return {row(0, 0), row(1, 1), row(2, 2), row(0, 1), row(1, 2), row(0, 2)};
}

/// Largest eigenvalue of a symmetric tensor (closed form, Smith 1961).
inline double largest_eigenvalue(const Sym3& a) {
  const double mean = trace(a) / 3;
  const Sym3 s = deviator(a);
  const double p2 = contract(s, s) / 6;
  if (!(p2 > 0)) return mean;
  const double p = std::sqrt(p2);
  const double det = s[0] * (s[1] * s[2] - s[4] * s[4]) - s[3] * (s[3] * s[2] - s[4] * s[5]) +
                     s[5] * (s[3] * s[4] - s[1] * s[5]);
  const double r = std::fmin(1.0, std::fmax(-1.0, det / (2 * p2 * p)));
  return mean + 2 * p * std::cos(std::acos(r) / 3);
}

} // namespace spall
