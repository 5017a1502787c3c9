#pragma once

#include "macro/integration/gradient_rows.h"
#include "macro/solid/point_kinematics.h"

namespace spall {

/// The two loops over the neighbours of one point, where half of the time goes. `first`, `last`: its pairs in
/// the rows; velocities and forces are those of the block's touched points as (x, y, z, unused).

/// sum_J v_J (x) G_J in all lanes: rates of F with respect to the last refresh.
template<int L, class T>
MatLanes<L> gather_rates(const GradientRows<T>& rows, std::uint32_t first, std::uint32_t last,
                         const Lanes<T>* velocity) {
  const auto& records = rows.template records<L>();
  MatLanes<L> rate;
  if constexpr (L == 1) {
    std::array<Lanes<T>, 3> sum{}; // the derivatives as lanes
    for (std::uint32_t p = first; p < last; ++p) {
      const Lanes<T> v = velocity[rows.column[p]], g = records[p];
      for (int c = 0; c < 3; ++c) sum[c] += v[c] * g;
    }
    for (int c = 0; c < 3; ++c)
      for (int d = 0; d < 3; ++d) rate[c][d] = sum[c][d];
  } else {
    std::array<std::array<Lanes<T, L>, 3>, 3> sum{};
    for (std::uint32_t p = first; p < last; ++p) {
      const Lanes<T> v = velocity[rows.column[p]];
      for (int d = 0; d < 3; ++d) {
        const Lanes<T, L> g = records[3 * p + d];
        for (int c = 0; c < 3; ++c) sum[c][d] += v[c] * g;
      }
    }
    for (int c = 0; c < 3; ++c)
      for (int d = 0; d < 3; ++d) rate[c][d] = convert_lanes<L, double, T>(sum[c][d]);
  }
  return rate;
}

/// Adds sum over lanes of nominal : G_J to the force on every neighbour: the transpose of gather_rates.
/// nominal[d][c] multiplies the d-th derivative and gives the force along c.
template<int L, class T>
void scatter_forces(const GradientRows<T>& rows, std::uint32_t first, std::uint32_t last,
                    const MatLanes<L>& nominal, Lanes<T>* force) {
  const auto& records = rows.template records<L>();
  std::array<std::array<Lanes<T>, L>, 3> column;
  for (int d = 0; d < 3; ++d)
    for (int m = 0; m < L; ++m)
      column[d][m] =
          Lanes<T>{T(get_lane<L, double>(nominal[d][0], m)), T(get_lane<L, double>(nominal[d][1], m)),
                   T(get_lane<L, double>(nominal[d][2], m)), 0};
  for (std::uint32_t p = first; p < last; ++p) {
    Lanes<T> f = force[rows.column[p]];
    if constexpr (L == 1) {
      const Lanes<T> g = records[p];
      for (int d = 0; d < 3; ++d) f += g[d] * column[d][0];
    } else {
      for (int d = 0; d < 3; ++d) {
        const Lanes<T, L> g = records[3 * p + d];
        for (int m = 0; m < L; ++m) f += g[m] * column[d][m];
      }
    }
    force[rows.column[p]] = f;
  }
}

} // namespace spall
