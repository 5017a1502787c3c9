#pragma once

#include "macro/points/lanes.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <type_traits>

namespace spall {

/// Functions of one number or of several side by side: V is double or Lanes<double, L>. They have no
/// branches, so that lanes cost about as much as one number.

template<class V> inline constexpr bool is_number = std::is_same_v<V, double>;

/// One number or several: no integer.
template<class V>
concept Numbers = is_number<V> || requires(V lanes) {
  lanes[0];
};

/// The same number in all lanes.
template<class V> constexpr V broadcast(double x) {
  if constexpr (is_number<V>)
    return x;
  else
    return V{} + x;
}

/// Result of a comparison: bool, or one integer per lane, all of whose bits are set where it is true.
template<class V> using Mask = decltype(V{} < V{});

namespace detail {
template<class M> struct OfMask { typedef double type __attribute__((vector_size(sizeof(M)))); };
template<> struct OfMask<bool> { typedef double type; };
template<> struct OfMask<int> { typedef double type; }; // of bool & bool

/// A number in all lanes, or lanes as they are.
template<class V, class A> constexpr V widen(const A& a) {
  if constexpr (std::is_arithmetic_v<A>)
    return broadcast<V>(a);
  else
    return a;
}
template<class A, class B>
using Wider =
    std::conditional_t<!std::is_arithmetic_v<A>, A, std::conditional_t<!std::is_arithmetic_v<B>, B, double>>;
} // namespace detail

/// a where the mask is true, b elsewhere; each may be the same number in all lanes. Both have been computed:
/// what is not chosen may be no number.
template<class M, class A, class B> auto select(const M& mask, const A& a, const B& b) {
  using V = typename detail::OfMask<M>::type;
  const V x = detail::widen<V>(a), y = detail::widen<V>(b);
  return mask ? x : y;
}

/// Whether a mask is true in some lane.
template<class M> bool any(const M& mask) {
  if constexpr (std::is_integral_v<M>) {
    return mask;
  } else {
    auto bits = mask[0];
    for (std::size_t m = 1; m < sizeof(mask) / sizeof(mask[0]); ++m) bits |= mask[m];
    return bits != 0;
  }
}

/// The first lane where a mask is true, if there is one.
template<class M> std::size_t first_of(const M& mask) {
  std::size_t m = 0;
  if constexpr (!std::is_integral_v<M>)
    while (mask[m] == 0) ++m;
  return m;
}

/// The larger one, as std::max: a if one of them is no number.
template<class A, class B> auto larger(const A& a, const B& b) {
  using V = detail::Wider<A, B>;
  const V x = detail::widen<V>(a), y = detail::widen<V>(b);
  return select(x < y, y, x);
}
/// The smaller one, as std::min: a if one of them is no number.
template<class A, class B> auto smaller(const A& a, const B& b) {
  using V = detail::Wider<A, B>;
  const V x = detail::widen<V>(a), y = detail::widen<V>(b);
  return select(y < x, y, x);
}

template<class V> V square_root(V x) {
  if constexpr (is_number<V>) {
    return std::sqrt(x);
  } else {
    for (std::size_t m = 0; m < sizeof(V) / sizeof(double); ++m) x[m] = std::sqrt(x[m]);
    return x;
  }
}

/// The bits of a number as an integer, and back.
template<class V> using Bits = std::conditional_t<is_number<V>, std::int64_t, Mask<V>>;

/// Polynomial with the coefficients of x^0, x^1, ... (Horner).
template<class V, std::size_t N> V polynomial(const std::array<double, N>& coefficients, const V& x) {
  V sum = broadcast<V>(coefficients[N - 1]);
  for (std::size_t k = N - 1; k-- > 0;) sum = sum * x + coefficients[k];
  return sum;
}

/// exp(x) to two units in the last place, for |x| < 700: 2^k exp(r) with |r| <= ln 2 / 2 and the Taylor
/// polynomial of exp(r).
template<class V> V exponential_function(const V& x) {
  constexpr double shift = 6755399441055744.; // 1.5 2^52: adding it rounds to an integer in the lowest bits
  constexpr double high = 0x1.62e42feep-1, low = 0x1.a39ef35793c76p-33; // ln 2 in two parts
  static constexpr std::array<double, 14> factorials = [] {
    std::array<double, 14> c{1};
    for (std::size_t k = 1; k < c.size(); ++k) c[k] = c[k - 1] / static_cast<double>(k);
    return c;
  }();
  const V shifted = x * std::numbers::log2e + shift, k = shifted - shift;
  const V r = (x - k * high) - k * low;
  const Bits<V> power = (std::bit_cast<Bits<V>>(shifted) << 52) + (std::int64_t{1023} << 52);
  return polynomial(factorials, r) * std::bit_cast<V>(power);
}

/// ln(x) to two units in the last place of max(1, |ln x|), for normal numbers x > 0: x = 2^k m with m between
/// 0.7 and 1.4, ln m = 2 artanh(s), s = (m - 1) / (m + 1).
template<class V> V natural_logarithm(const V& x) {
  constexpr std::int64_t one = std::bit_cast<std::int64_t>(1.0),
                         root = std::bit_cast<std::int64_t>(0.70710678), exponent = std::int64_t{0xfff} << 52;
  constexpr double shift = 6755399441055744.; // as above: the integer k in the lowest bits becomes a number
  static constexpr std::array<double, 11> odd = [] {
    std::array<double, 11> c{};
    for (std::size_t k = 0; k < c.size(); ++k) c[k] = 2 / (2 * static_cast<double>(k) + 1);
    return c;
  }();
  const Bits<V> bits = std::bit_cast<Bits<V>>(x), above = (bits - root) & exponent;
  const V m = std::bit_cast<V>(bits - above);
  const V k = std::bit_cast<V>((above >> 52) + std::bit_cast<std::int64_t>(shift)) - shift;
  const V s = (m - 1.0) / (m + 1.0);
  static_assert(one > root);
  return k * std::numbers::ln2 + s * polynomial(odd, V(s * s));
}

namespace detail {

/// cos(a / 3) as a polynomial in 2 cos(a / 2) - 1, for angles a from 0 to pi. As a function of cos(a / 2) it
/// is analytic up to -1, so its Chebyshev series converges as 5.8^-n. Coefficients of the powers.
inline std::array<double, 20> cosine_of_third_coefficients() {
  constexpr std::size_t n = 20;
  std::array<double, n> chebyshev{}, powers{}, before{1}, present{0, 1};
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t j = 0; j < n; ++j) {
      const double angle = std::numbers::pi * (static_cast<double>(j) + 0.5) / n;
      chebyshev[k] += (k == 0 ? 1. : 2.) / n * std::cos(2 * std::acos((1 + std::cos(angle)) / 2) / 3) *
                      std::cos(static_cast<double>(k) * angle);
    }
  for (std::size_t k = 0; k < n; ++k) { // T_k+1 = 2 u T_k - T_k-1
    std::array<double, n> next{};
    for (std::size_t p = 0; p < n; ++p) {
      powers[p] += chebyshev[k] * before[p];
      next[p] = (p > 0 ? 2 * present[p - 1] : 0) - before[p];
    }
    before = present, present = next;
  }
  return powers;
}
inline const std::array<double, 20> cosine_of_third_powers = cosine_of_third_coefficients();

} // namespace detail

/// cos(a / 3) from cos a, for angles a from 0 to pi, to 1e-14: the largest root y of 4 y^3 - 3 y = cos a.
template<class V> V cosine_of_third(const V& cosine) {
  const V half = square_root<V>(larger(0, V(0.5 + 0.5 * smaller(1, cosine))));
  return polynomial(detail::cosine_of_third_powers, V(2.0 * half - 1.0));
}

} // namespace spall
