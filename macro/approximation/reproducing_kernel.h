#pragma once

#include "macro/approximation/kernel.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace spall {

/// The points that an evaluation may see, in the coordinates xi of its support (radius 1), centred on the
/// point the support belongs to. Arrays, reused from point to point.
template<class T> struct Cloud {
  std::array<std::vector<T>, 3> xi;
  std::vector<T> phi;                  ///< kernel at the last evaluation
  std::array<std::vector<T>, 3> slope; ///< its derivatives d phi / d xi, if they were asked for
  std::vector<std::uint32_t> index;

  std::size_t size() const { return index.size(); }
  void clear() {
    for (auto& x : xi) x.clear();
    index.clear();
  }
  void add(std::uint32_t i, T a, T b, T c) {
    index.push_back(i);
    xi[0].push_back(a), xi[1].push_back(b), xi[2].push_back(c);
  }
};

/// Below this fraction of the bulk determinant the second moment of a cloud is regularised: the cloud (a
/// fragment's rim, a lone row of points) cannot hold the linear basis. The outermost point of a lattice with
/// a support of two spacings has 0.51 of it at a flat face, 0.26 at an edge, 0.13 at a corner (dense clouds:
/// 0.35, 0.12, 0.041).
inline constexpr double singular_fraction = 0.03;
/// What is added to the second moment (in units of the bulk's) where it is singular: the quasi-linear idea of
/// Yreux and Chen (2017), fictitious neighbours on the axes that keep it invertible and shrink the gradient
/// along directions the cloud does not resolve. Constants stay reproduced exactly.
inline constexpr double regularization = 0.1;

/// Moments of the kernel about the evaluation point, order 1 basis (paper Eqs. 3-6 with n = 1), in centred
/// form: with d_J = xi_J - mean the moment matrix splits into mu0 and the 3x3 second moment C = sum phi d
/// d^T, whose inverse is all that the shape functions need.
template<class T> struct Moments {
  T mu0 = 0;
  std::array<T, 3> mean{};    ///< relative to the evaluation point
  std::array<T, 3> origin{};  ///< the same in xi
  std::array<T, 6> inverse{}; ///< of C: xx, yy, zz, xy, yz, xz
  T fraction = 0;             ///< determinant of C before regularisation as a part of the bulk's
  bool regularized = true;

  std::array<T, 3> times_inverse(T a, T b, T c) const {
    return {inverse[0] * a + inverse[3] * b + inverse[5] * c,
            inverse[3] * a + inverse[1] * b + inverse[4] * c,
            inverse[5] * a + inverse[4] * b + inverse[2] * c};
  }
};

/// Kernel values (with Slopes also their derivatives) of the cloud seen from the offset `at`, and their
/// moments.
template<class Kernel, bool Slopes, class T>
Moments<T> evaluate_moments(Cloud<T>& cloud, const std::array<T, 3>& at) {
  const std::size_t n = cloud.size();
  cloud.phi.resize(n);
  const T *x = cloud.xi[0].data(), *y = cloud.xi[1].data(), *z = cloud.xi[2].data();
  T* phi = cloud.phi.data();
  std::array<T*, 3> slope{};
  if constexpr (Slopes)
    for (int c = 0; c < 3; ++c) {
      cloud.slope[c].resize(n);
      slope[c] = cloud.slope[c].data();
    }
  T mu0 = 0, mx = 0, my = 0, mz = 0;
#pragma omp simd reduction(+ : mu0, mx, my, mz)
  for (std::size_t j = 0; j < n; ++j) {
    const T a = x[j] - at[0], b = y[j] - at[1], c = z[j] - at[2];
    phi[j] = Kernel::value(a, b, c);
    if constexpr (Slopes) {
      const std::array<T, 3> g = Kernel::slope(a, b, c);
      slope[0][j] = g[0], slope[1][j] = g[1], slope[2][j] = g[2];
    }
    mu0 += phi[j];
    mx += phi[j] * a, my += phi[j] * b, mz += phi[j] * c;
  }
  Moments<T> m;
  m.mu0 = mu0;
  if (!(mu0 > 0)) return m;
  m.mean = {mx / mu0, my / mu0, mz / mu0};
  T xx = 0, yy = 0, zz = 0, xy = 0, yz = 0, xz = 0;
  m.origin = {at[0] + m.mean[0], at[1] + m.mean[1], at[2] + m.mean[2]};
  const T ox = m.origin[0], oy = m.origin[1], oz = m.origin[2];
#pragma omp simd reduction(+ : xx, yy, zz, xy, yz, xz)
  for (std::size_t j = 0; j < n; ++j) {
    const T a = x[j] - ox, b = y[j] - oy, c = z[j] - oz;
    xx += phi[j] * a * a, yy += phi[j] * b * b, zz += phi[j] * c * c;
    xy += phi[j] * a * b, yz += phi[j] * b * c, xz += phi[j] * a * c;
  }
  const auto det = [&] {
    return xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz);
  };
  const T bulk = T(Kernel::second_moment) * mu0;
  T determinant = det();
  m.fraction = determinant / (bulk * bulk * bulk);
  m.regularized = !(m.fraction > T(singular_fraction));
  if (m.regularized) {
    xx += T(regularization) * bulk, yy += T(regularization) * bulk, zz += T(regularization) * bulk;
    determinant = det();
  }
  const T s = 1 / determinant;
  m.inverse = {(yy * zz - yz * yz) * s, (xx * zz - xz * xz) * s, (xx * yy - xy * xy) * s,
               (xz * yz - xy * zz) * s, (xy * xz - xx * yz) * s, (xy * yz - xz * yy) * s};
  return m;
}

/// Gradient with respect to xi at the evaluation point, and its derivatives along xi_1..3 (Hillman and Chen
/// 2016, implicit gradient). B_J = C^-1 d_J phi_J; with d_k phi the change of the kernel when the evaluation
/// point moves, q_k = sum(d_k phi d) / mu0 and T_k = sum(d_k phi d d^T):  d_k B_J = C^-1 [d_k phi_J d_J -
/// phi_J q_k - T_k B_J]. sum_J B_J = 0 and sum_J d_k B_J = 0 hold for any cloud; linear fields give their
/// exact gradient and zero derivatives over any cloud that is not regularised.
template<class T> struct GradientOperator {
  using Value = T;
  Moments<T> moments;
  std::array<std::array<T, 3>, 3> q{};
  std::array<std::array<T, 6>, 3> third{};

  bool outside() const { return moments.regularized; } ///< the cloud cannot hold the linear basis here
  bool lowered() const { return moments.regularized; } ///< nor the basis asked for
  T fraction() const { return moments.fraction; }
  /// Shape functions of all points of the cloud (paper Eq. 8, linear basis, centred form): Psi = phi (1 / mu0
  /// - mean . C^-1 d). They sum to 1 and reproduce linear fields over any cloud that is not regularised.
  void values(const Cloud<T>& cloud, T* psi) const {
    const std::array<T, 3> w = moments.times_inverse(moments.mean[0], moments.mean[1], moments.mean[2]);
    const T *x = cloud.xi[0].data(), *y = cloud.xi[1].data(), *z = cloud.xi[2].data(),
            *phi = cloud.phi.data();
    const T ox = moments.origin[0], oy = moments.origin[1], oz = moments.origin[2];
    const T constant = 1 / moments.mu0;
#pragma omp simd
    for (std::size_t j = 0; j < cloud.size(); ++j)
      psi[j] = phi[j] * (constant - w[0] * (x[j] - ox) - w[1] * (y[j] - oy) - w[2] * (z[j] - oz));
  }

  /// Collects the sums of the derivatives from a cloud whose moments and slopes have just been evaluated.
  void collect_derivatives(const Cloud<T>& cloud) {
    for (int k = 0; k < 3; ++k) {
      const T *x = cloud.xi[0].data(), *y = cloud.xi[1].data(), *z = cloud.xi[2].data();
      const T* slope = cloud.slope[k].data();
      const T ox = moments.origin[0], oy = moments.origin[1], oz = moments.origin[2];
      T qx = 0, qy = 0, qz = 0, xx = 0, yy = 0, zz = 0, xy = 0, yz = 0, xz = 0;
#pragma omp simd reduction(+ : qx, qy, qz, xx, yy, zz, xy, yz, xz)
      for (std::size_t j = 0; j < cloud.size(); ++j) {
        const T dphi = -slope[j], a = x[j] - ox, b = y[j] - oy, c = z[j] - oz;
        qx += dphi * a, qy += dphi * b, qz += dphi * c;
        xx += dphi * a * a, yy += dphi * b * b, zz += dphi * c * c;
        xy += dphi * a * b, yz += dphi * b * c, xz += dphi * a * c;
      }
      q[k] = {qx / moments.mu0, qy / moments.mu0, qz / moments.mu0};
      third[k] = {xx, yy, zz, xy, yz, xz};
    }
  }
  /// Spatial derivatives of all points of the cloud, with x = inverse^-1 xi: out[0..2] the gradient and, if
  /// wanted, out[3 + 3k ..] its derivative along xi_k times `weight`. Products of matrices that do not depend
  /// on the point are taken out of the loop over the points, which is left with plain arithmetic on arrays.
  template<bool Derivatives>
  void differentiate(const Cloud<T>& cloud, const std::array<T, 9>& inverse_support, T weight,
                     const std::array<T*, 12>& out) const {
    std::array<T, 9> m, c; // m = A^-T C^-1, c = C^-1
    c = {moments.inverse[0], moments.inverse[3], moments.inverse[5], moments.inverse[3], moments.inverse[1],
         moments.inverse[4], moments.inverse[5], moments.inverse[4], moments.inverse[2]};
    const auto times = [](const std::array<T, 9>& l, const std::array<T, 9>& r) {
      std::array<T, 9> p{};
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          p[3 * i + j] = l[3 * i] * r[j] + l[3 * i + 1] * r[3 + j] + l[3 * i + 2] * r[6 + j];
      return p;
    };
    const std::array<T, 9>& a = inverse_support;
    m = times({a[0], a[3], a[6], a[1], a[4], a[7], a[2], a[5], a[8]}, c);
    std::array<std::array<T, 9>, 3> mt; // m T_k C^-1
    std::array<std::array<T, 3>, 3> mq; // m q_k
    for (int k = 0; k < 3; ++k) {
      const std::array<T, 6>& t = third[k];
      mt[k] = times(times(m, {t[0], t[3], t[5], t[3], t[1], t[4], t[5], t[4], t[2]}), c);
      for (int i = 0; i < 3; ++i)
        mq[k][i] = m[3 * i] * q[k][0] + m[3 * i + 1] * q[k][1] + m[3 * i + 2] * q[k][2];
    }
    const T *x = cloud.xi[0].data(), *y = cloud.xi[1].data(), *z = cloud.xi[2].data();
    const T* phi = cloud.phi.data();
    const T ox = moments.origin[0], oy = moments.origin[1], oz = moments.origin[2];
    const std::size_t n = cloud.size();
    for (int i = 0; i < 3; ++i) {
      T* g = out[i];
      const T a0 = m[3 * i], a1 = m[3 * i + 1], a2 = m[3 * i + 2];
#pragma omp simd
      for (std::size_t j = 0; j < n; ++j)
        g[j] = phi[j] * (a0 * (x[j] - ox) + a1 * (y[j] - oy) + a2 * (z[j] - oz));
    }
    if constexpr (Derivatives) {
      for (int k = 0; k < 3; ++k)
        for (int i = 0; i < 3; ++i) {
          T* d = out[3 + 3 * k + i];
          const T* slope = cloud.slope[k].data();
          const T a0 = m[3 * i], a1 = m[3 * i + 1], a2 = m[3 * i + 2], t0 = mt[k][3 * i],
                  t1 = mt[k][3 * i + 1], t2 = mt[k][3 * i + 2], qi = mq[k][i];
#pragma omp simd
          for (std::size_t j = 0; j < n; ++j) {
            const T u = x[j] - ox, v = y[j] - oy, w = z[j] - oz;
            d[j] =
                weight * (-slope[j] * (a0 * u + a1 * v + a2 * w) - phi[j] * (qi + t0 * u + t1 * v + t2 * w));
          }
        }
    }
  }
};

/// Basis of order 1, the common one.
template<class Kernel> struct LinearBasis {
  static constexpr bool box = Kernel::is_box, has_derivatives = true;
  /// Operator at a place of the support; with Derivatives it can differentiate the gradient too.
  template<bool Derivatives, class T>
  static GradientOperator<T> evaluate(Cloud<T>& cloud, const std::array<T, 3>& at) {
    GradientOperator<T> op{evaluate_moments<Kernel, Derivatives>(cloud, at)};
    if constexpr (Derivatives) op.collect_derivatives(cloud);
    return op;
  }
};

} // namespace spall
