#pragma once

#include "macro/points/tensor.h"

namespace spall {

inline double determinant(const Sym3& a) {
  return a[0] * (a[1] * a[2] - a[4] * a[4]) - a[3] * (a[3] * a[2] - a[4] * a[5]) +
         a[5] * (a[3] * a[4] - a[1] * a[5]);
}

/// Principal values of a symmetric tensor, descending (closed form, Smith 1961).
inline std::array<double, 3> principal_values(const Sym3& a) {
  const double mean = trace(a) / 3;
  const Sym3 s = deviator(a);
  const double p2 = contract(s, s) / 6;
  if (!(p2 > 0)) return {mean, mean, mean};
  const double p = std::sqrt(p2);
  const double cosine =
      std::cos(std::acos(std::fmin(1.0, std::fmax(-1.0, determinant(s) / (2 * p2 * p)))) / 3);
  // The last root is a third of a turn further: cos(angle + 2 pi / 3).
  const double first = 2 * p * cosine,
               last = -p * (cosine + std::sqrt(3 * std::fmax(0.0, 1 - cosine * cosine)));
  return {mean + first, mean - first - last, mean + last};
}

/// A stress without tension in any direction: all principal minors of -a are >= 0.
inline bool is_compressive(const Sym3& a) {
  return a[0] <= 0 && a[1] <= 0 && a[2] <= 0 && a[0] * a[1] >= a[3] * a[3] && a[1] * a[2] >= a[4] * a[4] &&
         a[0] * a[2] >= a[5] * a[5] && determinant(a) <= 0;
}

} // namespace spall
