#pragma once

#include "macro/integration/ring_operators.h"
#include "macro/solid/point_kinematics.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace spall {

/// The two loops over the neighbours of one point take half of the time of a step. `first` and `last` say
/// which pairs of the block are those of the point; velocities and forces are those of the block's stencil
/// points, as (x, y, z, unused).

/// Numbers of a pair's record in memory, and the registers that hold them. The last register of the last pair
/// reads beyond its record (GradientOperators::slack).
template<int L> constexpr std::uint32_t numbers_of_pair = L == 1 ? 4 : 3 * L;
template<std::uint32_t numbers, class T>
constexpr std::uint32_t registers_for = (numbers + register_lanes<T> - 1) / register_lanes<T>;
template<int L, class T> const T* numbers_of(const GradientOperators<T>& operators, std::uint32_t pair) {
  const T* first = reinterpret_cast<const T*>(operators.template records<L>().data());
  return first + numbers_of_pair<L> * std::size_t(pair);
}

/// gather_rates for rings around the axis.
template<int L, class T>
Mat<Lanes<T, L>> gather_rates_of_rings(const GradientOperators<T>& operators, std::uint32_t first,
                                       std::uint32_t last, const Lanes<T>* velocity) {
  using Record = RingRecord<T, L>;
  const auto& records = operators.template records<L>();
  std::array<typename Record::Vector, Record::size> sum{};
  for (std::uint32_t p = first; p < last; ++p) {
    const Lanes<T> v = velocity[operators.column[p]];
    const auto* g = &records[Record::size * p];
    for (std::uint32_t k = 0; k < Record::size; ++k) sum[k] += v[k < Record::of_radial ? 0 : 2] * g[k];
  }
  Mat<Lanes<T, L>> rate{};
  if constexpr (L == 1) {
    rate(0, 0) = sum[0][0], rate(0, 2) = sum[0][1], rate(1, 1) = sum[0][2];
    rate(2, 0) = sum[1][0], rate(2, 2) = sum[1][1];
  } else {
    for (std::uint32_t k = 0; k < Record::size; ++k) rate(Record::row[k], Record::column[k]) = sum[k];
  }
  return rate;
}

/// The rates of F since the last refresh, sum_J v_J G_J^T, by each of the point's L gradient operators G,
/// 1/s.
template<int L, class T>
Mat<Lanes<T, L>> gather_rates(const GradientOperators<T>& operators, std::uint32_t first, std::uint32_t last,
                              const Lanes<T>* velocity) {
  if (operators.rings) return gather_rates_of_rings<L>(operators, first, last, velocity);
  constexpr std::uint32_t numbers = numbers_of_pair<L>, registers = registers_for<numbers, T>,
                          in_register = register_lanes<T>;
  const T* g = numbers_of<L>(operators, first);
  std::array<Vec<Register<T>>, registers> sum{}; // of one component of the velocity
  for (std::uint32_t p = first; p < last; ++p, g += numbers) {
    const T* v = reinterpret_cast<const T*>(&velocity[operators.column[p]]);
    unrolled<registers>([&](auto k) {
      const Register<T> gradients = read_register(g + k * in_register);
      unrolled<3>([&](auto c) { sum[k][c] += v[c] * gradients; });
    });
  }
  Mat<Lanes<T, L>> rate;
  unrolled<3>([&](auto c) {
    unrolled<3>([&](auto d) {
      constexpr std::size_t number = d * L, k = number / in_register, place = number % in_register;
      if constexpr (L == 1)
        rate(c, d) = sum[k][c][place];
      else if constexpr (L <= in_register)
        rate(c, d) = part<place, L>(sum[k][c]);
      else
        rate(c, d) = join(sum[k][c], sum[k + 1][c]);
    });
  });
  return rate;
}

/// scatter_forces for rings around the axis.
template<int L, class T>
void scatter_forces_to_rings(const GradientOperators<T>& operators, std::uint32_t first, std::uint32_t last,
                             const Mat<Lanes<T, L>>& nominal, Lanes<T>* force) {
  using Record = RingRecord<T, L>;
  using Vector = typename Record::Vector;
  const auto& records = operators.template records<L>();
  std::array<Vector, Record::size> along; // force per unit of the record
  if constexpr (L == 1) {
    const Mat<T>& n = nominal;
    along = {Vector{n(0, 0), n(2, 0), n(1, 1), 0}, Vector{n(0, 2), n(2, 2), 0, 0}};
  } else {
    for (std::uint32_t k = 0; k < Record::size; ++k) along[k] = nominal(Record::column[k], Record::row[k]);
  }
  for (std::uint32_t p = first; p < last; ++p) {
    const Vector* g = &records[Record::size * p];
    Vector radial{}, axial{};
    for (std::uint32_t k = 0; k < Record::of_radial; ++k) radial += g[k] * along[k];
    for (std::uint32_t k = Record::of_radial; k < Record::size; ++k) axial += g[k] * along[k];
    force[operators.column[p]] += Lanes<T>{sum_of_lanes(radial), 0, sum_of_lanes(axial), 0};
  }
}

/// Adds sum_m G_Jm . nominal_m, over the operators m, to the force on every neighbour J, N: the transpose of
/// gather_rates, so that forces do the work of the stresses. Component (d, c) of `nominal` multiplies the
/// d-th derivative and gives the force along c.
/// @param ahead how many numbers further the records are that the loop fetches into the cache: those of the
/// points that come next, which the processor does not foresee beyond a page of memory
template<int L, class T>
void scatter_forces(const GradientOperators<T>& operators, std::uint32_t first, std::uint32_t last,
                    const Mat<Lanes<T, L>>& nominal, Lanes<T>* force, std::size_t ahead = 0) {
  if (operators.rings) return scatter_forces_to_rings<L>(operators, first, last, nominal, force);
  constexpr std::uint32_t numbers = numbers_of_pair<L>, registers = registers_for<numbers, T>,
                          in_register = register_lanes<T>;
  // Force per unit of each number: of the d-th derivative of operator m.
  std::array<decltype(registers_of<T>({})), numbers / 4> along;
  unrolled<numbers / 4>([&](auto four) {
    if constexpr (L == 1) {
      const auto of = [&](int d) { return Lanes<T>{nominal(d, 0), nominal(d, 1), nominal(d, 2), 0}; };
      along[four] = registers_of<T>({of(0), of(1), of(2), Lanes<T>{}});
    } else {
      constexpr std::size_t d = 4 * four / L, m = 4 * four % L;
      const auto of = [&](int c) { return part<m, 4>(nominal(d, c)); };
      along[four] = registers_of<T>(transpose(std::array{of(0), of(1), of(2), Lanes<T>{}}));
    }
  });
  const T* g = numbers_of<L>(operators, first);
  for (std::uint32_t p = first; p < last; ++p, g += numbers) {
    Register<T> sum{};
    unrolled<registers>([&](auto k) {
      const Register<T> gradients = read_register(g + k * in_register);
      unrolled<4>([&](auto q) {
        constexpr std::size_t number = k * in_register + q * in_register / 4;
        if constexpr (number < numbers)
          sum += four_times<q>(gradients) * along[number / 4][number % 4 * 4 / in_register];
      });
    });
    __builtin_prefetch(g + ahead);
    force[operators.column[p]] += sum_of_fours<T>(sum);
  }
}

} // namespace spall
