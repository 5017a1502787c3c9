#pragma once

#include <array>
#include <cmath>
#include <compare>
#include <cstddef>

namespace spall {

/// Vectors and second-order tensors in three dimensions. T: double, or a vector of lanes (lanes.h) that holds
/// several tensors side by side. Operators act on every component; products that are more than that have
/// names.
template<class T> struct Vec {
  using Component = T;
  std::array<T, 3> components;

  constexpr T& operator[](std::size_t i) { return components[i]; }
  constexpr const T& operator[](std::size_t i) const { return components[i]; }
  constexpr auto begin() { return components.begin(); }
  constexpr auto begin() const { return components.begin(); }
  constexpr auto end() { return components.end(); }
  constexpr auto end() const { return components.end(); }
  static constexpr std::size_t size() { return 3; }
  friend constexpr auto operator<=>(const Vec&, const Vec&) = default;
};

/// Symmetric, in the order xx, yy, zz, xy, yz, xz (tensor components: shear is not doubled).
template<class T> struct Sym {
  using Component = T;
  std::array<T, 6> components;

  constexpr T& operator[](std::size_t i) { return components[i]; }
  constexpr const T& operator[](std::size_t i) const { return components[i]; }
  constexpr auto begin() { return components.begin(); }
  constexpr auto begin() const { return components.begin(); }
  constexpr auto end() { return components.end(); }
  constexpr auto end() const { return components.end(); }
  static constexpr std::size_t size() { return 6; }
  /// Component of row i and column j.
  constexpr const T& operator()(int i, int j) const { return components[i == j ? i : i + j == 1 ? 3 : i + j == 3 ? 4 : 5]; }
  friend constexpr bool operator==(const Sym&, const Sym&) = default;
};

/// General, row by row.
template<class T> struct Mat {
  using Component = T;
  std::array<T, 9> components;

  constexpr T& operator[](std::size_t i) { return components[i]; }
  constexpr const T& operator[](std::size_t i) const { return components[i]; }
  constexpr auto begin() { return components.begin(); }
  constexpr auto begin() const { return components.begin(); }
  constexpr auto end() { return components.end(); }
  constexpr auto end() const { return components.end(); }
  static constexpr std::size_t size() { return 9; }
  /// Component of row i and column j.
  constexpr T& operator()(int i, int j) { return components[3 * i + j]; }
  constexpr const T& operator()(int i, int j) const { return components[3 * i + j]; }
  friend constexpr bool operator==(const Mat&, const Mat&) = default;
};

using Vec3 = Vec<double>;
using Sym3 = Sym<double>;
using Mat3 = Mat<double>;

inline constexpr Mat3 identity3 = {1, 0, 0, 0, 1, 0, 0, 0, 1};

template<class A>
concept TensorType = requires(A a) {
  typename A::Component;
  a.components;
};
/// What multiplies a tensor: a number, or one per lane.
template<class S>
concept ScalarType = !TensorType<S>;

template<TensorType A> constexpr A& operator+=(A& a, const A& b) {
  for (std::size_t k = 0; k < A::size(); ++k) a[k] += b[k];
  return a;
}
template<TensorType A> constexpr A& operator-=(A& a, const A& b) {
  for (std::size_t k = 0; k < A::size(); ++k) a[k] -= b[k];
  return a;
}
template<TensorType A, ScalarType S> constexpr A& operator*=(A& a, const S& s) {
  for (std::size_t k = 0; k < A::size(); ++k) a[k] *= s;
  return a;
}
template<TensorType A, ScalarType S> constexpr A& operator/=(A& a, const S& s) {
  for (std::size_t k = 0; k < A::size(); ++k) a[k] /= s;
  return a;
}
template<TensorType A> constexpr A operator+(A a, const A& b) { return a += b; }
template<TensorType A> constexpr A operator-(A a, const A& b) { return a -= b; }
template<TensorType A, ScalarType S> constexpr A operator*(const S& s, A a) { return a *= s; }
template<TensorType A, ScalarType S> constexpr A operator*(A a, const S& s) { return a *= s; }
template<TensorType A, ScalarType S> constexpr A operator/(A a, const S& s) { return a /= s; }
template<TensorType A> constexpr A operator-(A a) {
  for (auto& component : a) component = -component;
  return a;
}

// ---- vectors

template<class T> constexpr T dot(const Vec<T>& a, const Vec<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template<class T> constexpr Vec<T> cross(const Vec<T>& a, const Vec<T>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double norm(const Vec3& a) { return std::sqrt(dot(a, a)); }
/// The unit vector along a vector that is not zero.
inline Vec3 unit(const Vec3& a) { return 1 / norm(a) * a; }

// ---- symmetric tensors

template<class T> constexpr T trace(const Sym<T>& a) { return a[0] + a[1] + a[2]; }

/// a : b
template<class T> constexpr T contract(const Sym<T>& a, const Sym<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + 2.0 * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5]);
}

/// a + s 1
template<class T, ScalarType S> constexpr Sym<T> plus_spherical(Sym<T> a, const S& s) {
  for (int i = 0; i < 3; ++i) a[i] += s;
  return a;
}

template<class T> constexpr Sym<T> deviator(const Sym<T>& a) {
  const T mean = trace(a) / 3.0;
  return {a[0] - mean, a[1] - mean, a[2] - mean, a[3], a[4], a[5]};
}

/// Equivalent (von Mises) stress of a deviator: sqrt(3/2 s : s).
inline double equivalent_stress(const Sym3& s) { return std::sqrt(1.5 * contract(s, s)); }

inline double determinant(const Sym3& a) {
  return a[0] * (a[1] * a[2] - a[4] * a[4]) - a[3] * (a[3] * a[2] - a[4] * a[5]) +
         a[5] * (a[3] * a[4] - a[1] * a[5]);
}

/// Principal values of a symmetric tensor, descending (closed form, Smith 1961).
inline Vec3 principal_values(const Sym3& a) {
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

/// Largest eigenvalue of a symmetric tensor (closed form, Smith 1961).
inline double largest_eigenvalue(const Sym3& a) {
  const double mean = trace(a) / 3;
  const Sym3 s = deviator(a);
  const double p2 = contract(s, s) / 6;
  if (!(p2 > 0)) return mean;
  const double p = std::sqrt(p2);
  const double r = std::fmin(1.0, std::fmax(-1.0, determinant(s) / (2 * p2 * p)));
  return mean + 2 * p * std::cos(std::acos(r) / 3);
}

/// True if no direction is in tension: all principal minors of -a are >= 0.
inline bool is_compressive(const Sym3& a) {
  return a[0] <= 0 && a[1] <= 0 && a[2] <= 0 && a[0] * a[1] >= a[3] * a[3] && a[1] * a[2] >= a[4] * a[4] &&
         a[0] * a[2] >= a[5] * a[5] && determinant(a) <= 0;
}

// ---- general tensors

template<class T> constexpr T determinant(const Mat<T>& a) {
  return a[0] * (a[4] * a[8] - a[5] * a[7]) - a[1] * (a[3] * a[8] - a[5] * a[6]) +
         a[2] * (a[3] * a[7] - a[4] * a[6]);
}

template<class T> constexpr Mat<T> multiply(const Mat<T>& a, const Mat<T>& b) {
  Mat<T> c{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) c(i, j) = a(i, 0) * b(0, j) + a(i, 1) * b(1, j) + a(i, 2) * b(2, j);
  return c;
}

inline Mat3 inverse(const Mat3& a) {
  const double d = 1 / determinant(a);
  return {(a[4] * a[8] - a[5] * a[7]) * d, (a[2] * a[7] - a[1] * a[8]) * d, (a[1] * a[5] - a[2] * a[4]) * d,
          (a[5] * a[6] - a[3] * a[8]) * d, (a[0] * a[8] - a[2] * a[6]) * d, (a[2] * a[3] - a[0] * a[5]) * d,
          (a[3] * a[7] - a[4] * a[6]) * d, (a[1] * a[6] - a[0] * a[7]) * d, (a[0] * a[4] - a[1] * a[3]) * d};
}

template<class T> constexpr Mat<T> transpose(const Mat<T>& a) {
  return {a[0], a[3], a[6], a[1], a[4], a[7], a[2], a[5], a[8]};
}

/// a v
template<class T> constexpr Vec<T> times(const Mat<T>& a, const Vec<T>& v) {
  return {a[0] * v[0] + a[1] * v[1] + a[2] * v[2], a[3] * v[0] + a[4] * v[1] + a[5] * v[2],
          a[6] * v[0] + a[7] * v[1] + a[8] * v[2]};
}
/// a^T v
template<class T> constexpr Vec<T> times_transposed(const Mat<T>& a, const Vec<T>& v) {
  return {a[0] * v[0] + a[3] * v[1] + a[6] * v[2], a[1] * v[0] + a[4] * v[1] + a[7] * v[2],
          a[2] * v[0] + a[5] * v[1] + a[8] * v[2]};
}

/// a a^T
template<class T> constexpr Sym<T> times_transpose(const Mat<T>& a) {
  const auto row = [&a](int i, int j) { return a(i, 0) * a(j, 0) + a(i, 1) * a(j, 1) + a(i, 2) * a(j, 2); };
  return {row(0, 0), row(1, 1), row(2, 2), row(0, 1), row(1, 2), row(0, 2)};
}

/// (a + a^T) / 2
template<class T> constexpr Sym<T> symmetric_part(const Mat<T>& a) {
  return {a[0], a[4], a[8], 0.5 * (a[1] + a[3]), 0.5 * (a[5] + a[7]), 0.5 * (a[2] + a[6])};
}

} // namespace spall
