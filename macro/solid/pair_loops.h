#pragma once

#include "macro/integration/ring_operators.h"
#include "macro/solid/point_kinematics.h"

namespace spall {

/// The two loops over the neighbours of one point take half of the time of a step. `first` and `last` say
/// which pairs of the block are those of the point; velocities and forces are those of the block's stencil
/// points, as (x, y, z, unused).

/// gather_rates for rings around the axis.
template<int L, class T>
MatLanes<L> gather_rates_of_rings(const GradientOperators<T>& operators, std::uint32_t first,
                                  std::uint32_t last, const Lanes<T>* velocity) {
  using Record = RingRecord<T, L>;
  const auto& records = operators.template records<L>();
  std::array<typename Record::Vector, Record::size> sum{};
  for (std::uint32_t p = first; p < last; ++p) {
    const Lanes<T> v = velocity[operators.column[p]];
    const auto* g = &records[Record::size * p];
    for (std::uint32_t k = 0; k < Record::size; ++k) sum[k] += v[k < Record::of_radial ? 0 : 2] * g[k];
  }
  MatLanes<L> rate{};
  if constexpr (L == 1) {
    rate(0, 0) = sum[0][0], rate(0, 2) = sum[0][1], rate(1, 1) = sum[0][2];
    rate(2, 0) = sum[1][0], rate(2, 2) = sum[1][1];
  } else {
    for (std::uint32_t k = 0; k < Record::size; ++k)
      rate(Record::row[k], Record::column[k]) = convert_lanes<L, double, T>(sum[k]);
  }
  return rate;
}

/// The rates of F since the last refresh, sum_J v_J G_J^T, by each of the point's L gradient operators G,
/// 1/s.
template<int L, class T>
MatLanes<L> gather_rates(const GradientOperators<T>& operators, std::uint32_t first, std::uint32_t last,
                         const Lanes<T>* velocity) {
  if (operators.rings) return gather_rates_of_rings<L>(operators, first, last, velocity);
  const auto& records = operators.template records<L>();
  if constexpr (L == 1) {
    Vec<Lanes<T>> sum{}; // the rates of one component of the velocity: its derivatives side by side
    for (std::uint32_t p = first; p < last; ++p) {
      const Lanes<T> v = velocity[operators.column[p]], g = records[p];
      for (int c = 0; c < 3; ++c) sum[c] += v[c] * g;
    }
    return {sum[0][0], sum[0][1], sum[0][2], sum[1][0], sum[1][1],
            sum[1][2], sum[2][0], sum[2][1], sum[2][2]};
  } else if constexpr (L == 4) {
    Vec<Lanes<T, 8>> sum_xy{}; // of one component of the velocity: its rates by x and, beside, those by y
    Vec<Lanes<T>> sum_z{};
    const Lanes<T>* g = records.data() + 3 * std::size_t(first);
    for (std::uint32_t p = first; p < last; ++p, g += 3) {
      const T* v = reinterpret_cast<const T*>(&velocity[operators.column[p]]);
      const Lanes<T, 8> g_xy = __builtin_shufflevector(g[0], g[1], 0, 1, 2, 3, 4, 5, 6, 7);
      for (int c = 0; c < 3; ++c) sum_xy[c] += v[c] * g_xy, sum_z[c] += v[c] * g[2];
    }
    MatLanes<L> rate;
    for (int c = 0; c < 3; ++c) {
      const Lanes<T, 8> xy = sum_xy[c];
      rate(c, 0) = convert_lanes<L, double, T>(__builtin_shufflevector(xy, xy, 0, 1, 2, 3));
      rate(c, 1) = convert_lanes<L, double, T>(__builtin_shufflevector(xy, xy, 4, 5, 6, 7));
      rate(c, 2) = convert_lanes<L, double, T>(sum_z[c]);
    }
    return rate;
  } else {
    Mat<Lanes<T, L>> sum{};
    for (std::uint32_t p = first; p < last; ++p) {
      const Lanes<T> v = velocity[operators.column[p]];
      for (int d = 0; d < 3; ++d) {
        const Lanes<T, L> g = records[3 * p + d];
        for (int c = 0; c < 3; ++c) sum(c, d) += v[c] * g;
      }
    }
    return convert_lanes<L, double, T>(sum);
  }
}

/// scatter_forces for rings around the axis.
template<int L, class T>
void scatter_forces_to_rings(const GradientOperators<T>& operators, std::uint32_t first, std::uint32_t last,
                             const MatLanes<L>& nominal, Lanes<T>* force) {
  using Record = RingRecord<T, L>;
  using Vector = typename Record::Vector;
  const auto& records = operators.template records<L>();
  std::array<Vector, Record::size> along; // force per unit of the record
  if constexpr (L == 1) {
    const Mat<T> n = convert<T>(nominal);
    along = {Vector{n(0, 0), n(2, 0), n(1, 1), 0}, Vector{n(0, 2), n(2, 2), 0, 0}};
  } else {
    for (std::uint32_t k = 0; k < Record::size; ++k)
      along[k] = convert_lanes<L, T, double>(nominal(Record::column[k], Record::row[k]));
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
template<int L, class T>
void scatter_forces(const GradientOperators<T>& operators, std::uint32_t first, std::uint32_t last,
                    const MatLanes<L>& nominal, Lanes<T>* force) {
  if (operators.rings) return scatter_forces_to_rings<L>(operators, first, last, nominal, force);
  const auto& records = operators.template records<L>();
  std::array<std::array<Lanes<T>, L>, 3> along; // force per unit of the d-th derivative of operator m
  for (int m = 0; m < L; ++m) {
    const Mat3 of_operator = lane<L>(nominal, m);
    for (int d = 0; d < 3; ++d)
      along[d][m] = Lanes<T>{T(of_operator(d, 0)), T(of_operator(d, 1)), T(of_operator(d, 2)), 0};
  }
  // Numbers, not vectors: a factor of all lanes is read from memory where it is used.
  constexpr int numbers = L == 1 ? 4 : 3 * L;
  const T* g = reinterpret_cast<const T*>(records.data()) + numbers * std::size_t(first);
  for (std::uint32_t p = first; p < last; ++p, g += numbers) {
    Lanes<T>& f = force[operators.column[p]];
    std::array<Lanes<T>, 3> part; // independent sums
    for (int d = 0; d < 3; ++d) {
      part[d] = g[L * d] * along[d][0];
      for (int m = 1; m < L; ++m) part[d] += g[L * d + m] * along[d][m];
    }
    f += part[0] + part[1] + part[2];
  }
}

} // namespace spall
