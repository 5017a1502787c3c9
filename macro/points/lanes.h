#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <type_traits>
#include <utility>

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

/// The lanes of two vectors, one after the other.
template<class V> auto join(const V& a, const V& b) {
  return [&]<std::size_t... lane>(std::index_sequence<lane...>) {
    return __builtin_shufflevector(a, b, static_cast<int>(lane)...);
  }
  (std::make_index_sequence<2 * sizeof(a) / sizeof(a[0])>{});
}
/// The lanes from `first` on of a vector, as many as there are in vectors of `size`.
template<std::size_t first, std::size_t size, class V> auto part(const V& a) {
  return [&]<std::size_t... lane>(std::index_sequence<lane...>) {
    return __builtin_shufflevector(a, a, static_cast<int>(first + lane)...);
  }
  (std::make_index_sequence<size>{});
}

/// Four vectors of four numbers, rows and columns exchanged.
template<class V> std::array<V, 4> transpose(const std::array<V, 4>& rows) {
  const auto& [a, b, c, d] = rows;
  const V ab = __builtin_shufflevector(a, b, 0, 4, 1, 5), ab_ = __builtin_shufflevector(a, b, 2, 6, 3, 7),
          cd = __builtin_shufflevector(c, d, 0, 4, 1, 5), cd_ = __builtin_shufflevector(c, d, 2, 6, 3, 7);
  return {__builtin_shufflevector(ab, cd, 0, 1, 4, 5), __builtin_shufflevector(ab, cd, 2, 3, 6, 7),
          __builtin_shufflevector(ab_, cd_, 0, 1, 4, 5), __builtin_shufflevector(ab_, cd_, 2, 3, 6, 7)};
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

/// Numbers of L records, N each, as N vectors that hold one number per record.
/// @param records where the numbers of each record begin
template<int N, int L, class To, class From>
std::array<Lanes<To, L>, N> side_by_side(const std::array<const From*, L>& records) {
  std::array<Lanes<To, L>, N> lanes;
  if constexpr (L == 8 && N >= 4) {
    for (int k = 0; k < N; k += 4) {
      const int first = std::min(k, N - 4); // the last four may have been among those before
      const auto columns = [&](int m) {
        std::array<Lanes<From>, 4> four;
        for (int j = 0; j < 4; ++j) std::memcpy(&four[j], records[m + j] + first, sizeof four[j]);
        return transpose(four);
      };
      const auto low = columns(0), high = columns(4);
      for (int j = 0; j < 4; ++j)
        lanes[first + j] = join(convert_lanes<4, To, From>(low[j]), convert_lanes<4, To, From>(high[j]));
    }
  } else {
    for (int k = 0; k < N; ++k)
      for (int m = 0; m < L; ++m) set_lane<L, To>(lanes[k], m, static_cast<To>(records[m][k]));
  }
  return lanes;
}
/// The reverse: writes the numbers of every record.
template<int N, int L, class To, class From>
void one_by_one(const std::array<Lanes<From, L>, N>& lanes, const std::array<To*, L>& records) {
  if constexpr (L == 8 && N >= 4) {
    for (int k = 0; k < N; k += 4) {
      const int first = std::min(k, N - 4);
      std::array<Lanes<To>, 4> low, high;
      for (int j = 0; j < 4; ++j) {
        low[j] = convert_lanes<4, To, From>(part<0, 4>(lanes[first + j]));
        high[j] = convert_lanes<4, To, From>(part<4, 4>(lanes[first + j]));
      }
      low = transpose(low), high = transpose(high);
      for (int j = 0; j < 4; ++j) {
        std::memcpy(records[j] + first, &low[j], sizeof low[j]);
        std::memcpy(records[4 + j] + first, &high[j], sizeof high[j]);
      }
    }
  } else {
    for (int k = 0; k < N; ++k)
      for (int m = 0; m < L; ++m) records[m][k] = static_cast<To>(get_lane<L, From>(lanes[k], m));
  }
}

/// Bytes of a vector register of the processor.
#if defined(__AVX512F__)
inline constexpr int register_bytes = 64;
#elif defined(__AVX__)
inline constexpr int register_bytes = 32;
#else
inline constexpr int register_bytes = 16;
#endif
/// As many numbers as a register holds, but at least four.
template<class T>
inline constexpr std::size_t register_lanes = std::max<std::size_t>(4, register_bytes / sizeof(T));
template<class T> using Register = Lanes<T, register_lanes<T>>;

/// Reads a register. The compiler must not read it again where it is used, as g++ would.
template<class T> Register<T> read_register(const T* numbers) {
  Register<T> value;
  std::memcpy(&value, numbers, sizeof value);
#ifdef __x86_64__
  if constexpr (sizeof value == register_bytes) asm("" : "+x"(value));
#endif
  return value;
}

/// Calls action(k) for k from 0 to n - 1, one after the other and not in a loop, as for_each_component does.
template<std::size_t n, class Action> [[gnu::always_inline]] constexpr void unrolled(const Action& action) {
  [&action]<std::size_t... k>(std::index_sequence<k...>) __attribute__((always_inline)) {
    (action(std::integral_constant<std::size_t, k>{}), ...);
  }
  (std::make_index_sequence<n>{});
}

/// The q-th quarter of the numbers, each in four lanes.
template<std::size_t q, class V> V four_times(const V& a) {
  constexpr std::size_t quarter = sizeof(a) / sizeof(a[0]) / 4;
  return [&]<std::size_t... lane>(std::index_sequence<lane...>) {
    return __builtin_shufflevector(a, a, (static_cast<int>(q * quarter + lane / 4))...);
  }
  (std::make_index_sequence<4 * quarter>{});
}
/// Four vectors of four side by side in registers.
template<class T> auto registers_of(const std::array<Lanes<T>, 4>& fours) {
  const auto& [a, b, c, d] = fours;
  if constexpr (sizeof(Register<T>) == sizeof(a))
    return fours;
  else if constexpr (sizeof(Register<T>) == 2 * sizeof(a))
    return std::array{join(a, b), join(c, d)};
  else
    return std::array{join(join(a, b), join(c, d))};
}
/// The sum of the vectors of four in a register.
template<class T, class V> Lanes<T> sum_of_fours(const V& a) {
  constexpr std::size_t half = sizeof(a) / sizeof(a[0]) / 2;
  if constexpr (half == 2)
    return a;
  else
    return sum_of_fours<T>(part<0, half>(a) + part<half, half>(a));
}

} // namespace spall
