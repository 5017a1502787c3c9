#pragma once

#include "macro/approximation/reproducing_kernel.h"

namespace spall {

/// Below this fraction of the bulk's determinant (see MonomialBasisOperator::fraction) the quadratic terms of
/// a cloud are dropped and the linear basis is used. The outermost point of a lattice has, with the cubic
/// spline and a support of 3 spacings, 0.030 of it at a face, 8e-4 at an edge, 2e-5 at a corner (2.5
/// spacings: 0.011, 2e-4, 4e-6); with 2 spacings a face has two layers, which cannot tell x^2 from x, and
/// none of it.
inline constexpr double singular_quadratic_fraction = 1e-6;

/// Shape functions and their derivatives by the textbook's moment matrix (paper Eqs. 3-8) for any order of
/// the monomial basis, in double. LinearBasis is the fast form of order 1.
///
/// Every result is a combination H(xi_J - at) . (p phi_J + c d_k phi_J), where d_k phi is the change of the
/// kernel when the evaluation point moves along xi_k. With order 1 and 2 the gradient is the implicit one:
/// the coefficient of the linear term, exact for the basis without derivatives of the kernel. Order 0 has
/// none; its gradient is the derivative of the shape function phi_J / mu0.
template<int Order, class T> struct MonomialBasisOperator {
  static constexpr int size = Order == 0 ? 1 : Order == 1 ? 4 : 10;
  using Vector = std::array<double, size>;

  Vec<T> at{};
  Vector value{};
  /// Rows 0-2: the gradient; 3 + 3 k + i: change of its i-th component along k.
  std::array<Vector, 12> p{}, c{};
  double determinant = 1; ///< see fraction()
  bool cannot_hold_linear = false, is_lowered = false;

  Vector monomials(const Cloud<T>& cloud, std::size_t j) const {
    const double x = cloud.xi[0][j] - at[0], y = cloud.xi[1][j] - at[1], z = cloud.xi[2][j] - at[2];
    if constexpr (Order == 0)
      return {1};
    else if constexpr (Order == 1)
      return {1, x, y, z};
    else
      return {1, x, y, z, x * x, y * y, z * z, x * y, y * z, x * z};
  }
  static double dot(const Vector& a, const Vector& b) {
    double sum = 0;
    for (int k = 0; k < size; ++k) sum += a[k] * b[k];
    return sum;
  }

  bool outside() const { return cannot_hold_linear; }
  bool lowered() const { return is_lowered; }
  /// Order 1: determinant of the second moment as a part of the bulk's. Order 2: the same of what the linear
  /// basis leaves of the quadratic terms.
  T fraction() const { return T(determinant); }
  void values(const Cloud<T>& cloud, T* psi) const {
    for (std::size_t j = 0; j < cloud.size(); ++j)
      psi[j] = T(dot(monomials(cloud, j), value) * static_cast<double>(cloud.phi[j]));
  }
  /// As LinearBasisOperator::differentiate.
  template<bool Derivatives>
  void differentiate(const Cloud<T>& cloud, const Mat<T>& inverse_support, T weight,
                     const std::array<T*, 12>& out) const {
    constexpr int rows = Derivatives ? 12 : 3;
    for (std::size_t j = 0; j < cloud.size(); ++j) {
      const Vector h = monomials(cloud, j);
      double along[rows];
      for (int r = 0; r < rows; ++r) {
        along[r] = dot(h, p[r]) * static_cast<double>(cloud.phi[j]);
        if (Derivatives || Order == 0)
          along[r] -= dot(h, c[r]) * static_cast<double>(cloud.slope[r < 3 ? r : r / 3 - 1][j]);
      }
      for (int r = 0; r < rows; ++r) {
        const double* g = along + r / 3 * 3;
        const double space = inverse_support(0, r % 3) * g[0] + inverse_support(1, r % 3) * g[1] +
                             inverse_support(2, r % 3) * g[2];
        out[r][j] = T(r < 3 ? space : static_cast<double>(weight) * space);
      }
    }
  }
};

template<class Kernel, int Order> struct MonomialBasis {
  static constexpr bool box = Kernel::is_box, has_derivatives = Order > 0;

  /// Operator at a place of the support; with Derivatives it can differentiate the gradient too (order 1, 2).
  template<bool Derivatives, class T>
  static MonomialBasisOperator<Order, T> evaluate(Cloud<T>& cloud, const Vec<T>& at) {
    static_assert(Order > 0 || !Derivatives);
    constexpr bool slopes = Derivatives || Order == 0;
    const Moments<T> linear = evaluate_moments<Kernel, slopes>(cloud, at);
    MonomialBasisOperator<Order, T> op;
    op.at = at;
    op.cannot_hold_linear = op.is_lowered = !(linear.mu0 > 0);
    if (op.is_lowered) return op;
    // Moment matrix (Eq. 6) and its changes when the evaluation point moves, the basis held where it is.
    Matrix m{};
    std::array<Matrix, 3> change{};
    for (std::size_t j = 0; j < cloud.size(); ++j) {
      const auto h = op.monomials(cloud, j);
      add_square(m, h, cloud.phi[j]);
      if constexpr (slopes)
        for (int k = 0; k < 3; ++k) add_square(change[k], h, -cloud.slope[k][j]);
    }
    if constexpr (Order == 0) {
      op.value[0] = 1 / m[0][0];
      for (int k = 0; k < 3; ++k) {
        op.c[k][0] = 1 / m[0][0];
        op.p[k][0] = -change[k][0][0] / (m[0][0] * m[0][0]);
      }
    } else {
      op.cannot_hold_linear = op.is_lowered = linear.regularized;
      op.determinant = static_cast<double>(linear.fraction);
      if (linear.regularized)
        for (int k = 1; k < 4; ++k) m[k][k] += regularization * Kernel::second_moment * m[0][0];
      const double mu0 = m[0][0];
      invert(m, 0, 4);
      if constexpr (Order == 2) {
        Matrix full = m;
        const double quadratic = invert(full, 4, N) / (bulk_determinant() * std::pow(mu0, 6));
        if (!linear.regularized) op.determinant = quadratic;
        op.is_lowered = linear.regularized || !(quadratic > singular_quadratic_fraction);
        if (!op.is_lowered) m = full;
      }
      set_coefficients<Derivatives>(op, m, change, op.is_lowered ? 4 : N);
    }
    return op;
  }

private:
  static constexpr int N = MonomialBasisOperator<Order, float>::size;
  using Matrix = std::array<std::array<double, N>, N>;

  static void add_square(Matrix& m, const std::array<double, N>& h, double weight) {
    for (int a = 0; a < N; ++a)
      for (int b = 0; b < N; ++b) m[a][b] += weight * h[a] * h[b];
  }

  /// Determinant, in units of mu0^6, of what the linear basis leaves of the quadratic terms in a dense
  /// uniform cloud: xy, yz and xz have variance <x^2 y^2>; x^2, y^2 and z^2 have v = <x^4> - <x^2>^2 and
  /// covariance w = <x^2 y^2> - <x^2>^2, determinant (v - w)^2 (v + 2 w).
  static double bulk_determinant() {
    constexpr double square = Kernel::second_moment * Kernel::second_moment,
                     v = Kernel::fourth_moment - square, w = Kernel::mixed_moment - square;
    return (v - w) * (v - w) * (v + 2 * w) * std::pow(Kernel::mixed_moment, 3);
  }

  /// Sweeps rows begin .. end-1 (Goodnight 1979): after all rows have been swept m holds its inverse, after
  /// the first n the inverse of its first n rows and columns. @return product of the pivots: the determinant
  /// of what the rows swept before leave of these.
  static double invert(Matrix& m, int begin, int end) {
    double determinant = 1;
    for (int k = begin; k < end; ++k) {
      const double pivot = m[k][k];
      determinant *= pivot;
      for (int b = 0; b < N; ++b) m[k][b] /= pivot;
      for (int a = 0; a < N; ++a) {
        if (a == k) continue;
        const double factor = m[a][k];
        for (int b = 0; b < N; ++b) m[a][b] -= factor * m[k][b];
        m[a][k] = -factor / pivot;
      }
      m[k][k] = 1 / pivot;
    }
    return determinant;
  }

  /// Coefficients with the first `count` terms of the basis. G_i = e_i . M^-1 H_J phi_J; moving the place by
  /// d along xi_k turns e_i into e_i + d (second derivative of the basis) and M into M + d change_k.
  template<bool Derivatives, class Operator>
  static void set_coefficients(Operator& op, const Matrix& inverse, const std::array<Matrix, 3>& change,
                               int count) {
    for (int a = 0; a < count; ++a) {
      op.value[a] = inverse[a][0];
      for (int i = 0; i < 3; ++i) op.p[i][a] = inverse[a][1 + i];
    }
    if constexpr (Derivatives)
      for (int k = 0; k < 3; ++k)
        for (int i = 0; i < 3; ++i) {
          auto &p = op.p[3 + 3 * k + i], &c = op.c[3 + 3 * k + i];
          c = op.p[i];
          std::array<double, N> moved{};
          for (int a = 0; a < count; ++a)
            for (int b = 0; b < count; ++b) moved[a] += change[k][a][b] * c[b];
          const int second = i == k       ? 4 + i
                             : i + k == 1 ? 7
                             : i + k == 3 ? 8
                                          : 9; // index of d^2 / d xi_i d xi_k
          for (int a = 0; a < count; ++a) {
            for (int b = 0; b < count; ++b) p[a] -= inverse[a][b] * moved[b];
            if (count == 10) p[a] += (i == k ? 2 : 1) * inverse[a][second % N];
          }
        }
  }
};

} // namespace spall
