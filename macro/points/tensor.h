#pragma once

#include "macro/points/lane_math.h"

#include <array>
#include <cmath>
#include <compare>
#include <cstddef>
#include <tuple>
#include <utility>

namespace spall {

/// Vectors and second-order tensors in three dimensions. T is float, double, or a vector of lanes (lanes.h),
/// which holds several tensors side by side. The operators +, - and * by a scalar act on every component; all
/// other products have names. Indices run from 0 to 2.
///
/// Closed forms are used throughout. Against Eigen 3.4 (one core, -O3, AVX-512) they take: principal values
/// 46 ns against 105 (computeDirect) and 430 ns (iterative); inverse 6.0 against 7.3 ns; determinant and
/// product the same.
///
/// A vector can be taken apart: const auto [x, y, z] = v.
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
  template<std::size_t I> constexpr const T& get() const { return components[I]; }
  friend constexpr auto operator<=>(const Vec&, const Vec&) = default;
};

/// Symmetric tensor, with its components in the order xx, yy, zz, xy, yz, xz. Shear components are those of
/// the tensor, not engineering shear (which is twice as large).
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
  constexpr const T& operator()(int i, int j) const {
    return components[i == j ? i : i + j == 1 ? 3 : i + j == 3 ? 4 : 5];
  }
  friend constexpr bool operator==(const Sym&, const Sym&) = default;
};

/// General tensor, stored row by row.
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

template<class V> constexpr Mat<V> identity_of() {
  const V one = broadcast<V>(1), zero = broadcast<V>(0);
  return {one, zero, zero, zero, one, zero, zero, zero, one};
}
inline constexpr Mat3 identity3 = {1, 0, 0, 0, 1, 0, 0, 0, 1};

template<class A>
concept TensorType = requires(A a) {
  typename A::Component;
  a.components;
};
/// A scalar multiplies all components of a tensor: a number, or one number per lane.
template<class S>
concept ScalarType = !TensorType<S>;
/// Component of the product of a tensor with component T and a scalar or tensor of another type, for example
/// of a tensor of numbers and a vector of lanes.
template<class T, class S> using ProductOf = decltype(std::declval<T>() * std::declval<S>());

/// Calls action(k) for the components k of a tensor A, one after the other and not in a loop: a compiler
/// holds arrays in registers only if it knows the indices before it looks for loops to unroll.
template<TensorType A, class Action>
[[gnu::always_inline]] constexpr void for_each_component(const Action& action) {
  [&action]<std::size_t... k>(std::index_sequence<k...>) __attribute__((always_inline)) { (action(k), ...); }
  (std::make_index_sequence<A::size()>{});
}

template<TensorType A> constexpr A& operator+=(A& a, const A& b) {
  for_each_component<A>([&](std::size_t k) { a[k] += b[k]; });
  return a;
}
template<TensorType A> constexpr A& operator-=(A& a, const A& b) {
  for_each_component<A>([&](std::size_t k) { a[k] -= b[k]; });
  return a;
}
template<TensorType A, ScalarType S> constexpr A& operator*=(A& a, const S& s) {
  for_each_component<A>([&](std::size_t k) { a[k] *= s; });
  return a;
}
template<TensorType A, ScalarType S> constexpr A& operator/=(A& a, const S& s) {
  for_each_component<A>([&](std::size_t k) { a[k] /= s; });
  return a;
}
template<TensorType A> constexpr A operator+(A a, const A& b) { return a += b; }
template<TensorType A> constexpr A operator-(A a, const A& b) { return a -= b; }
template<template<class> class A, class T, ScalarType S>
requires TensorType<A<T>>
constexpr A<ProductOf<T, S>> operator*(const A<T>& a, const S& s) {
  A<ProductOf<T, S>> product{};
  for_each_component<A<T>>([&](std::size_t k) { product[k] = a[k] * s; });
  return product;
}
template<template<class> class A, class T, ScalarType S>
requires TensorType<A<T>>
constexpr A<ProductOf<T, S>> operator*(const S& s, const A<T>& a) { return a * s; }
template<TensorType A, ScalarType S> constexpr A operator/(A a, const S& s) { return a /= s; }
template<TensorType A> constexpr A operator-(A a) {
  for_each_component<A>([&](std::size_t k) { a[k] = -a[k]; });
  return a;
}

/// Largest magnitude of a component; 0 if none is a number.
template<TensorType A> double largest_component(const A& a) {
  double largest = 0;
  for_each_component<A>([&](std::size_t k) {
    const double size = std::abs(a[k]);
    if (size > largest) largest = size;
  });
  return largest;
}

/// The same of several tensors side by side.
template<template<class> class A, class V> V largest_components(const A<V>& a) {
  V largest = broadcast<V>(0);
  for_each_component<A<V>>([&](std::size_t k) { largest = larger(largest, larger(a[k], V(-a[k]))); });
  return largest;
}

/// Converts a tensor to another precision.
template<class To, template<class> class A, class From>
requires TensorType<A<From>>
constexpr A<To> convert(const A<From>& a) {
  A<To> converted{};
  for_each_component<A<From>>([&](std::size_t k) { converted[k] = static_cast<To>(a[k]); });
  return converted;
}

// ---- vectors

template<class T> constexpr T dot(const Vec<T>& a, const Vec<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template<class T> constexpr Vec<T> cross(const Vec<T>& a, const Vec<T>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double norm(const Vec3& a) { return std::sqrt(dot(a, a)); }
/// Distance from the z axis. Loops over the points call it, and std::hypot takes ten times as long.
inline double from_axis(const Vec3& a) { return std::sqrt(a[0] * a[0] + a[1] * a[1]); }
/// The unit vector along a vector that is not zero.
inline Vec3 unit(const Vec3& a) { return 1 / norm(a) * a; }

// ---- symmetric tensors

template<class T> constexpr T trace(const Sym<T>& a) { return a[0] + a[1] + a[2]; }

/// Converts a symmetric tensor to one with all nine components.
template<class T> constexpr Mat<T> full(const Sym<T>& a) {
  return {a[0], a[3], a[5], a[3], a[1], a[4], a[5], a[4], a[2]};
}

/// a v
template<class T> constexpr Vec<T> times(const Sym<T>& a, const Vec<T>& v) {
  return {a[0] * v[0] + a[3] * v[1] + a[5] * v[2], a[3] * v[0] + a[1] * v[1] + a[4] * v[2],
          a[5] * v[0] + a[4] * v[1] + a[2] * v[2]};
}

/// a : b
template<class T> constexpr T contract(const Sym<T>& a, const Sym<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + 2.0 * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5]);
}

/// a : b, as contract(), but added up component by component: xx, yy, zz, xy, yz, xz. The last bits differ.
template<class A, class B> constexpr ProductOf<A, B> contract_in_order(const Sym<A>& a, const Sym<B>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + 2.0 * a[3] * b[3] + 2.0 * a[4] * b[4] + 2.0 * a[5] * b[5];
}

/// a + s 1
template<class T, ScalarType S> constexpr Sym<T> plus_spherical(const Sym<T>& a, const S& s) {
  return {a[0] + s, a[1] + s, a[2] + s, a[3], a[4], a[5]};
}

template<class T> constexpr Sym<T> deviator(const Sym<T>& a) {
  const T mean = trace(a) / 3.0;
  return {a[0] - mean, a[1] - mean, a[2] - mean, a[3], a[4], a[5]};
}

/// Equivalent (von Mises) stress of a deviator: sqrt(3/2 s : s).
template<class T> T equivalent_stress(const Sym<T>& s) { return square_root(T(1.5 * contract(s, s))); }

template<class T> constexpr T determinant(const Sym<T>& a) {
  return a[0] * (a[1] * a[2] - a[4] * a[4]) - a[3] * (a[3] * a[2] - a[4] * a[5]) +
         a[5] * (a[3] * a[4] - a[1] * a[5]);
}

/// The inverse of a symmetric tensor with the given determinant, by cofactors.
template<class T> constexpr Sym<T> inverse(const Sym<T>& a, const T& determinant_of_a) {
  const T s = 1 / determinant_of_a;
  const auto& [xx, yy, zz, xy, yz, xz] = a.components;
  return {(yy * zz - yz * yz) * s, (xx * zz - xz * xz) * s, (xx * yy - xy * xy) * s,
          (xz * yz - xy * zz) * s, (xy * xz - xx * yz) * s, (xy * yz - xz * yy) * s};
}

/// Principal values of a symmetric tensor, descending (closed form, Smith 1961).
inline Vec3 principal_values(const Sym3& a) {
  const double mean = trace(a) / 3;
  const Sym3 s = deviator(a);
  const double p2 = contract(s, s) / 6;
  if (!(p2 > 0)) return {mean, mean, mean};
  const double p = std::sqrt(p2), cosine = cosine_of_third(determinant(s) / (2 * p2 * p));
  // The last root is a third of a turn further: cos(angle + 2 pi / 3).
  const double first = 2 * p * cosine,
               last = -p * (cosine + std::sqrt(3 * std::fmax(0.0, 1 - cosine * cosine)));
  return {mean + first, mean - first - last, mean + last};
}

/// The largest of them.
inline double largest_eigenvalue(const Sym3& a) { return principal_values(a)[0]; }

/// True if no direction is in tension: all principal minors of -a are >= 0.
inline bool is_compressive(const Sym3& a) {
  return a[0] <= 0 && a[1] <= 0 && a[2] <= 0 && a[0] * a[1] >= a[3] * a[3] && a[1] * a[2] >= a[4] * a[4] &&
         a[0] * a[2] >= a[5] * a[5] && determinant(a) <= 0;
}

// ---- general tensors

template<class T> constexpr T trace(const Mat<T>& a) { return a[0] + a[4] + a[8]; }

template<class T> constexpr Vec<T> row(const Mat<T>& a, int i) { return {a(i, 0), a(i, 1), a(i, 2)}; }

/// The outer product a b^T.
template<class T> constexpr Mat<T> outer(const Vec<T>& a, const Vec<T>& b) {
  return {a[0] * b[0], a[0] * b[1], a[0] * b[2], a[1] * b[0], a[1] * b[1],
          a[1] * b[2], a[2] * b[0], a[2] * b[1], a[2] * b[2]};
}

/// The axial vector w of the skew part: (a - a^T) / 2 v = w x v for every v. Of a velocity gradient it is the
/// spin.
template<class T> constexpr Vec<T> axial_vector(const Mat<T>& a) {
  return {0.5 * (a(2, 1) - a(1, 2)), 0.5 * (a(0, 2) - a(2, 0)), 0.5 * (a(1, 0) - a(0, 1))};
}

template<class T> constexpr T determinant(const Mat<T>& a) {
  return a[0] * (a[4] * a[8] - a[5] * a[7]) - a[1] * (a[3] * a[8] - a[5] * a[6]) +
         a[2] * (a[3] * a[7] - a[4] * a[6]);
}

/// a b
template<class A, class B = A> constexpr Mat<ProductOf<A, B>> multiply(const Mat<A>& a, const Mat<B>& b) {
  const auto entry = [&](int i, int j) { return a(i, 0) * b(0, j) + a(i, 1) * b(1, j) + a(i, 2) * b(2, j); };
  return {entry(0, 0), entry(0, 1), entry(0, 2), entry(1, 0), entry(1, 1),
          entry(1, 2), entry(2, 0), entry(2, 1), entry(2, 2)};
}

/// a^-1, by cofactors. The components are not finite if a is singular.
template<class T> constexpr Mat<T> inverse(const Mat<T>& a) {
  const T c0 = a[4] * a[8] - a[5] * a[7], c1 = a[3] * a[8] - a[5] * a[6], c2 = a[3] * a[7] - a[4] * a[6];
  const T d = 1 / (a[0] * c0 - a[1] * c1 + a[2] * c2);
  return {c0 * d,  (a[2] * a[7] - a[1] * a[8]) * d, (a[1] * a[5] - a[2] * a[4]) * d,
          -c1 * d, (a[0] * a[8] - a[2] * a[6]) * d, (a[2] * a[3] - a[0] * a[5]) * d,
          c2 * d,  (a[1] * a[6] - a[0] * a[7]) * d, (a[0] * a[4] - a[1] * a[3]) * d};
}

template<class T> constexpr Mat<T> transpose(const Mat<T>& a) {
  return {a[0], a[3], a[6], a[1], a[4], a[7], a[2], a[5], a[8]};
}

/// a v
template<class A, class B = A> constexpr Vec<ProductOf<A, B>> times(const Mat<A>& a, const Vec<B>& v) {
  return {a[0] * v[0] + a[1] * v[1] + a[2] * v[2], a[3] * v[0] + a[4] * v[1] + a[5] * v[2],
          a[6] * v[0] + a[7] * v[1] + a[8] * v[2]};
}
/// a^T v
template<class A, class B = A>
constexpr Vec<ProductOf<A, B>> times_transposed(const Mat<A>& a, const Vec<B>& v) {
  return {a[0] * v[0] + a[3] * v[1] + a[6] * v[2], a[1] * v[0] + a[4] * v[1] + a[7] * v[2],
          a[2] * v[0] + a[5] * v[1] + a[8] * v[2]};
}

/// a b^T, where that product is known to be symmetric.
template<class A, class B> constexpr Sym<ProductOf<A, B>> times_transpose(const Mat<A>& a, const Mat<B>& b) {
  const auto entry = [&](int i, int j) { return a(i, 0) * b(j, 0) + a(i, 1) * b(j, 1) + a(i, 2) * b(j, 2); };
  return {entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(1, 2), entry(0, 2)};
}
/// a a^T
template<class T> constexpr Sym<T> times_transpose(const Mat<T>& a) { return times_transpose(a, a); }

/// q s q^T: the tensor s turned by the rotation q.
template<class Q, class T> constexpr Sym<ProductOf<Q, T>> rotate(const Mat<Q>& q, const Sym<T>& s) {
  return times_transpose(multiply(q, full(s)), q);
}

/// (a + a^T) / 2
template<class T> constexpr Sym<T> symmetric_part(const Mat<T>& a) {
  return {a[0], a[4], a[8], 0.5 * (a[1] + a[3]), 0.5 * (a[5] + a[7]), 0.5 * (a[2] + a[6])};
}

} // namespace spall

// Vectors can be taken apart into their components. (Doxygen misses the first declarations.)
/// @cond
template<class T> struct std::tuple_size<spall::Vec<T>> : std::integral_constant<std::size_t, 3> {};
template<std::size_t I, class T> struct std::tuple_element<I, spall::Vec<T>> { using type = T; };
/// @endcond
