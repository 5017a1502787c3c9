#pragma once

#include "macro/approximation/kernel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace spall {

/// Makes a vector of working memory hold at least n values. It never shrinks, because values that are added
/// again would be set to zero first.
template<class V> void hold(V& values, std::size_t n) {
  if (values.size() < n) values.resize(n);
}

/// Points within reach of a support, in its coordinates xi: centred on the point the support belongs to, with
/// the radius 1. The arrays are used again from point to point, and may be longer than the cloud.
template<class T> struct Cloud {
  std::array<std::vector<T>, 3> xi;
  std::vector<T> phi;                  ///< kernel at the last evaluation
  std::array<std::vector<T>, 3> slope; ///< its derivatives d phi / d xi, if they were evaluated
  std::vector<std::uint32_t> index;
  std::size_t count = 0; ///< number of points

  std::size_t size() const { return count; }
  void clear() { count = 0; }
  void add(std::uint32_t i, T a, T b, T c) {
    if (count == index.size()) make_room(2 * count + 16);
    index[count] = i;
    xi[0][count] = a, xi[1][count] = b, xi[2][count] = c;
    ++count;
  }
  /// Makes room for n points in all.
  void make_room(std::size_t n) {
    for (auto& x : xi) hold(x, n);
    hold(index, n);
  }
  /// Turns offsets into coordinates xi = inverse_support x.
  void transform(const Mat<T>& inverse_support) {
    T *x = xi[0].data(), *y = xi[1].data(), *z = xi[2].data();
    const Mat<T> m = inverse_support;
#pragma omp simd
    for (std::size_t j = 0; j < size(); ++j) {
      const T a = x[j], b = y[j], c = z[j];
      x[j] = m(0, 0) * a + m(0, 1) * b + m(0, 2) * c;
      y[j] = m(1, 0) * a + m(1, 1) * b + m(1, 2) * c;
      z[j] = m(2, 0) * a + m(2, 1) * b + m(2, 2) * c;
    }
  }
  /// Keeps the points that are less than `reach` from the centre: along each axis in a Box, else in a ball.
  /// There is no branch on the points, which no processor could foresee.
  template<bool Box> void keep_within(T reach) {
    T *x = xi[0].data(), *y = xi[1].data(), *z = xi[2].data();
    std::uint32_t* i = index.data();
    std::size_t kept = 0;
    for (std::size_t j = 0, n = size(); j < n; ++j) {
      const T a = x[j], b = y[j], c = z[j];
      x[kept] = a, y[kept] = b, z[kept] = c, i[kept] = i[j];
      kept += Box ? std::max({std::abs(a), std::abs(b), std::abs(c)}) < reach
                  : a * a + b * b + c * c < reach * reach;
    }
    count = kept;
  }
};

/// Below this fraction of the bulk determinant the second moment of a cloud is regularised: the cloud (a
/// fragment's rim, a lone row of points) does not resolve the linear basis. The outermost point of a lattice
/// with a support of two spacings has 0.51 of it at a flat face, 0.26 at an edge, 0.13 at a corner (dense
/// clouds: 0.35, 0.12, 0.041).
inline constexpr double singular_fraction = 0.03;
/// Term that is added to the second moment (in units of the bulk's) where it is singular: the quasi-linear
/// idea of Yreux and Chen (2017), fictitious neighbours on the axes that keep it invertible and shrink the
/// gradient along directions the cloud does not resolve. Constants stay reproduced exactly.
inline constexpr double regularization = 0.1;

/// Moments of the kernel about the evaluation point, order 1 basis (paper Eqs. 3-6 with n = 1), in centred
/// form: with d_J = xi_J - mean the moment matrix splits into mu0 and the 3x3 second moment C = sum phi d
/// d^T, whose inverse is all that the shape functions need.
template<class T> struct Moments {
  T mu0 = 0;
  Vec<T> mean{};    ///< relative to the evaluation point
  Vec<T> origin{};  ///< mean in the coordinates xi
  Sym<T> inverse{}; ///< C^-1
  T fraction = 0;   ///< determinant of C before regularisation as a part of the bulk's
  bool regularized = true;
};

/// Adds up the sums over the cloud, relative to the evaluation point: kernel values (with Slopes also their
/// derivatives), mu0, mean and origin.
template<class Kernel, bool Slopes, class T> Moments<T> evaluate_kernel(Cloud<T>& cloud, const Vec<T>& at) {
  const std::size_t n = cloud.size();
  hold(cloud.phi, n);
  const T *x = cloud.xi[0].data(), *y = cloud.xi[1].data(), *z = cloud.xi[2].data();
  T* phi = cloud.phi.data();
  std::array<T*, 3> slope{};
  if constexpr (Slopes)
    for (int c = 0; c < 3; ++c) {
      hold(cloud.slope[c], n);
      slope[c] = cloud.slope[c].data();
    }
  T mu0 = 0, mx = 0, my = 0, mz = 0;
#pragma omp simd reduction(+ : mu0, mx, my, mz)
  for (std::size_t j = 0; j < n; ++j) {
    const T a = x[j] - at[0], b = y[j] - at[1], c = z[j] - at[2];
    phi[j] = Kernel::value(a, b, c);
    if constexpr (Slopes) {
      const Vec<T> g = Kernel::slope(a, b, c);
      slope[0][j] = g[0], slope[1][j] = g[1], slope[2][j] = g[2];
    }
    mu0 += phi[j];
    mx += phi[j] * a, my += phi[j] * b, mz += phi[j] * c;
  }
  Moments<T> m;
  m.mu0 = mu0;
  if (!(mu0 > 0)) return m;
  m.mean = Vec<T>{mx, my, mz} / mu0;
  m.origin = at + m.mean;
  return m;
}

/// The second moment sum_J w_J d_J d_J^T, with d_J = xi_J - origin, of the cloud weighted by w.
template<class T>
Sym<T> second_moment(const Cloud<T>& cloud, const Vec<T>& origin, const std::vector<T>& weight) {
  const T *x = cloud.xi[0].data(), *y = cloud.xi[1].data(), *z = cloud.xi[2].data(), *phi = weight.data();
  const T ox = origin[0], oy = origin[1], oz = origin[2];
  const std::size_t n = cloud.size();
  T xx = 0, yy = 0, zz = 0, xy = 0, yz = 0, xz = 0;
#pragma omp simd reduction(+ : xx, yy, zz, xy, yz, xz)
  for (std::size_t j = 0; j < n; ++j) {
    const T a = x[j] - ox, b = y[j] - oy, c = z[j] - oz;
    xx += phi[j] * a * a, yy += phi[j] * b * b, zz += phi[j] * c * c;
    xy += phi[j] * a * b, yz += phi[j] * b * c, xz += phi[j] * a * c;
  }
  return {xx, yy, zz, xy, yz, xz};
}

/// Kernel values (with Slopes also their derivatives) of the cloud about the offset `at`, and their
/// moments. All are dimensionless: lengths in units of the support's radius.
template<class Kernel, bool Slopes, class T>
Moments<T> evaluate_moments(Cloud<T>& cloud, const Vec<T>& at = {}) {
  Moments<T> m = evaluate_kernel<Kernel, Slopes>(cloud, at);
  if (!(m.mu0 > 0)) return m;
  Sym<T> second = second_moment(cloud, m.origin, cloud.phi);
  const T bulk = T(Kernel::second_moment) * m.mu0;
  T det = determinant(second);
  m.fraction = det / (bulk * bulk * bulk);
  m.regularized = !(m.fraction > T(singular_fraction));
  if (m.regularized) {
    second = plus_spherical(second, T(regularization) * bulk);
    det = determinant(second);
  }
  m.inverse = inverse(second, det);
  return m;
}

/// Gradient with respect to xi at the evaluation point, and its derivatives along xi_1..3 (Hillman and Chen
/// 2016, implicit gradient). B_J = C^-1 d_J phi_J; with d_k phi the change of the kernel when the evaluation
/// point moves, q_k = sum(d_k phi d) / mu0 and T_k = sum(d_k phi d d^T):  d_k B_J = C^-1 [d_k phi_J d_J -
/// phi_J q_k - T_k B_J]. sum_J B_J = 0 and sum_J d_k B_J = 0 hold for any cloud; linear fields give their
/// exact gradient and zero derivatives over any cloud that is not regularised.
template<class T> struct LinearBasisOperator {
  using Value = T;
  Moments<T> moments;
  std::array<Vec<T>, 3> q{};     ///< q_k
  std::array<Sym<T>, 3> third{}; ///< T_k

  bool outside() const { return moments.regularized; } ///< the cloud does not resolve the linear basis here
  bool lowered() const { return moments.regularized; } ///< the cloud does not resolve the chosen basis here
  T fraction() const { return moments.fraction; }
  /// Shape functions of all points of the cloud (paper Eq. 8, linear basis, centred form): Psi = phi (1 / mu0
  /// - mean . C^-1 d). They sum to 1 and reproduce linear fields over any cloud that is not regularised.
  void values(const Cloud<T>& cloud, T* psi) const {
    const Vec<T> w = times(moments.inverse, moments.mean);
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
      q[k] = Vec<T>{qx, qy, qz} / moments.mu0;
      third[k] = {xx, yy, zz, xy, yz, xz};
    }
  }
  /// Spatial derivatives of all points of the cloud, with xi = inverse_support x: out[0..2] is the gradient,
  /// 1/m, and with Derivatives out[3 + 3k ..] its derivative along xi_k times `weight`. Products of matrices
  /// that do not depend on the point are taken out of the loop over the points, which is left with plain
  /// arithmetic on arrays.
  template<bool Derivatives>
  void differentiate(const Cloud<T>& cloud, const Mat<T>& inverse_support, T weight,
                     const std::array<T*, 12>& out) const {
    const Mat<T> inverse_c = full(moments.inverse), m = multiply(transpose(inverse_support), inverse_c);
    const T *x = cloud.xi[0].data(), *y = cloud.xi[1].data(), *z = cloud.xi[2].data();
    const T* phi = cloud.phi.data();
    const T ox = moments.origin[0], oy = moments.origin[1], oz = moments.origin[2];
    const std::size_t n = cloud.size();
    for (int i = 0; i < 3; ++i) {
      T* g = out[i];
      const T a0 = m(i, 0), a1 = m(i, 1), a2 = m(i, 2);
#pragma omp simd
      for (std::size_t j = 0; j < n; ++j)
        g[j] = phi[j] * (a0 * (x[j] - ox) + a1 * (y[j] - oy) + a2 * (z[j] - oz));
    }
    if constexpr (Derivatives)
      for (int k = 0; k < 3; ++k) {
        const Mat<T> mt = multiply(multiply(m, full(third[k])), inverse_c);
        const Vec<T> mq = times(m, q[k]);
        for (int i = 0; i < 3; ++i) {
          T* d = out[3 + 3 * k + i];
          const T* slope = cloud.slope[k].data();
          const T a0 = m(i, 0), a1 = m(i, 1), a2 = m(i, 2), t0 = mt(i, 0), t1 = mt(i, 1), t2 = mt(i, 2),
                  qi = mq[i];
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

/// The basis of order 1, which is the default.
template<class Kernel> struct LinearBasis {
  static constexpr bool box = Kernel::is_box, has_derivatives = true;
  /// Operator at a place of the support; with Derivatives it can differentiate the gradient too.
  template<bool Derivatives, class T>
  static LinearBasisOperator<T> evaluate(Cloud<T>& cloud, const Vec<T>& at) {
    LinearBasisOperator<T> op{evaluate_moments<Kernel, Derivatives>(cloud, at)};
    if constexpr (Derivatives) op.collect_derivatives(cloud);
    return op;
  }
};

} // namespace spall
