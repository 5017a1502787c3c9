#pragma once

namespace spall {

/// Cubic B-spline on the unit ball, phi(r) for r in [0, 1], and g(r) = phi'(r) / r, finite at 0: what the
/// derivative of a radial kernel needs (d phi / d xi_k = g xi_k).
struct CubicSpline {
  template<class T> static T value(T r) {
    return r < T(0.5) ? T(2) / 3 - 4 * r * r * (1 - r)
           : r < 1    ? T(4) / 3 * (1 - r) * (1 - r) * (1 - r)
                      : T(0);
  }
  template<class T> static T slope_over_radius(T r) {
    return r < T(0.5) ? -8 + 12 * r : r < 1 ? -4 * (1 - r) * (1 - r) / r : T(0);
  }
};

} // namespace spall
