#pragma once

namespace spall {

/// L numbers that are computed at once, in SIMD fashion: by the processor's vector unit where it is wide
/// enough, plain code elsewhere (a vector extension of g++ and clang, correct on every machine). One lane is
/// the plain number.
template<class T, int L> struct LanesOf { typedef T type __attribute__((vector_size(L * sizeof(T)))); };
template<class T> struct LanesOf<T, 1> { typedef T type; };
template<class T, int L = 4> using Lanes = typename LanesOf<T, L>::type;

/// Number m of the lanes, whether they are a vector or a plain number.
template<int L, class T> T get_lane(const Lanes<T, L>& lanes, int m) {
  if constexpr (L == 1)
    return lanes;
  else
    return lanes[m];
}
template<int L, class T> void set_lane(Lanes<T, L>& lanes, int m, T value) {
  if constexpr (L == 1)
    lanes = value;
  else
    lanes[m] = value;
}

/// The sum of four or eight lanes, always in the same order.
template<class V> auto sum_of_lanes(const V& lanes) {
  if constexpr (sizeof(lanes) == 4 * sizeof(lanes[0]))
    return (lanes[0] + lanes[2]) + (lanes[1] + lanes[3]);
  else
    return ((lanes[0] + lanes[4]) + (lanes[2] + lanes[6])) + ((lanes[1] + lanes[5]) + (lanes[3] + lanes[7]));
}

/// Converts lanes to another precision.
template<int L, class To, class From> Lanes<To, L> convert_lanes(const Lanes<From, L>& lanes) {
  if constexpr (L == 1)
    return static_cast<To>(lanes);
  else
    return __builtin_convertvector(lanes, Lanes<To, L>);
}

} // namespace spall
