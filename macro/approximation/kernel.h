#pragma once

#include "macro/points/tensor.h"

#include <algorithm>
#include <cmath>

namespace spall {

/// Profiles of the kernel over the normalised distance r in [0, 1]: the value phi(r) and g(r) = phi'(r) / r,
/// finite at 0. The moments `<x^2>` and `<x^4>`, `<f>` = sum(phi f) / sum(phi), are those of a dense uniform
/// cloud in the unit ball (along one axis) and on the line [-1, 1].

/// Cubic B-spline: twice continuously differentiable.
struct CubicSpline {
  static constexpr double ball_second = 3. / 40, ball_fourth = 17. / 1120;
  static constexpr double line_second = 1. / 12, line_fourth = 3. / 160;
  template<class T> static T value(T r) {
    return r < T(0.5) ? T(2) / 3 - 4 * r * r * (1 - r)
           : r < 1    ? T(4) / 3 * (1 - r) * (1 - r) * (1 - r)
                      : T(0);
  }
  template<class T> static T slope_over_radius(T r) {
    return r < T(0.5) ? -8 + 12 * r : r < 1 ? -4 * (1 - r) * (1 - r) / r : T(0);
  }
};

/// Wendland's function C4 (Wendland 1995, positive definite in 3D): four times continuously differentiable,
/// one polynomial. More of its weight is near the centre (at half the radius 0.108 of the peak against 0.25
/// of the cubic spline), so that it needs a support about a fifth larger for the same second moment.
struct WendlandC4 {
  static constexpr double ball_second = 2. / 39, ball_fourth = 2. / 273;
  static constexpr double line_second = 3. / 55, line_fourth = 6. / 715;
  template<class T> static T value(T r) {
    const T s = std::max(T(0), 1 - r), s2 = s * s;
    return s2 * s2 * s2 * (1 + r * (6 + T(35) / 3 * r));
  }
  template<class T> static T slope_over_radius(T r) {
    const T s = std::max(T(0), 1 - r), s2 = s * s;
    return T(-56) / 3 * s2 * s2 * s * (1 + 5 * r);
  }
};

/// Kernel on the unit ball: phi(|xi|). With the support's metric it is a sphere or an ellipsoid.
template<class Profile> struct Ball {
  static constexpr double second_moment = Profile::ball_second, fourth_moment = Profile::ball_fourth;
  static constexpr double mixed_moment = fourth_moment / 3; ///< <x^2 y^2>
  static constexpr bool is_box = false;
  template<class T> static T value(T a, T b, T c) { return Profile::value(std::sqrt(a * a + b * b + c * c)); }
  /// d phi / d xi.
  template<class T> static Vec<T> slope(T a, T b, T c) {
    const T g = Profile::slope_over_radius(std::sqrt(a * a + b * b + c * c));
    return {g * a, g * b, g * c};
  }
};

/// Kernel on the cube [-1, 1]^3: the product phi(|xi_1|) phi(|xi_2|) phi(|xi_3|).
template<class Profile> struct Box {
  static constexpr double second_moment = Profile::line_second, fourth_moment = Profile::line_fourth;
  static constexpr double mixed_moment = second_moment * second_moment;
  static constexpr bool is_box = true;
  template<class T> static T value(T a, T b, T c) {
    return Profile::value(std::abs(a)) * Profile::value(std::abs(b)) * Profile::value(std::abs(c));
  }
  template<class T> static Vec<T> slope(T a, T b, T c) {
    const T u = std::abs(a), v = std::abs(b), w = std::abs(c);
    const T pu = Profile::value(u), pv = Profile::value(v), pw = Profile::value(w);
    return {a * Profile::slope_over_radius(u) * pv * pw, b * Profile::slope_over_radius(v) * pu * pw,
            c * Profile::slope_over_radius(w) * pu * pv};
  }
};

} // namespace spall
