#pragma once

#include "macro/material/material.h"
#include "macro/points/lanes.h"
#include "macro/points/tensor.h"

#include <array>
#include <cmath>
#include <type_traits>

namespace spall {

/// Symmetric tensors side by side, one per lane, in the order of Sym3. All are rotated and turned into forces
/// by the same operations. Lane 0 belongs to the gradient at the point itself.
template<int L> using SymLanes = Sym<Lanes<double, L>>;
/// General tensors side by side; [c][i] is the i-th derivative of the c-th component.
template<int L> using MatLanes = std::array<std::array<Lanes<double, L>, 3>, 3>;

/// Kinematics of one point over one step, for its gradient (lane 0) and for what else its rows hold.
/// Spin: double if all lanes turn with lane 0, Lanes<double, L> if each turns by its own spin.
template<int L, class Spin = double> struct StepKinematics {
  SymLanes<L> increment; ///< D dt of the middle of the step (Hughes and Winget 1980), turned to its end
  Mat<Spin> rotation; ///< of the step, Cayley transform of the spin
  Mat3 end;                     ///< relative deformation at the end of the step
  double volume_factor;         ///< det(end)
  double middle_factor;         ///< det at midstep
};

/// Rotation for the axial vector w of the spin times dt: (1 - W/2)^-1 (1 + W/2) = 1 + (W + W^2 / 2) / (1 +
/// |w|^2 / 4).
template<class V> Mat<V> cayley_rotation(V wx, V wy, V wz) {
  const V w2 = wx * wx + wy * wy + wz * wz, f = 1 / (1 + 0.25 * w2), h = 0.5 * f;
  return {1 + h * (wx * wx - w2), h * wx * wy - f * wz,   h * wx * wz + f * wy,
          h * wx * wy + f * wz,   1 + h * (wy * wy - w2), h * wy * wz - f * wx,
          h * wx * wz - f * wy,   h * wy * wz + f * wx,   1 + h * (wz * wz - w2)};
}

/// q s q^T in all lanes.
template<class Q, class V> Sym<V> rotate(const Mat<Q>& q, const Sym<V>& s) {
  const std::array<std::array<V, 3>, 3> full = {{{s[0], s[3], s[5]}, {s[3], s[1], s[4]}, {s[5], s[4], s[2]}}};
  std::array<std::array<V, 3>, 3> half;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      half[i][j] = q[3 * i] * full[0][j] + q[3 * i + 1] * full[1][j] + q[3 * i + 2] * full[2][j];
  const auto entry = [&](int i, int j) -> V {
    return half[i][0] * q[3 * j] + half[i][1] * q[3 * j + 1] + half[i][2] * q[3 * j + 2];
  };
  return {entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(1, 2), entry(0, 2)};
}

/// d + W d - d W for the axial vector w: q d q^T to first order of the rotation, without change of the trace.
template<class V, class Spin>
Sym<V> turn_slightly(Spin wx, Spin wy, Spin wz, const Sym<V>& d) {
  const V x = wx * d[4], y = wy * d[5], z = wz * d[3];
  return {d[0] + 2 * (y - z),
          d[1] + 2 * (z - x),
          d[2] + 2 * (x - y),
          d[3] + wz * (d[0] - d[1]) + wy * d[4] - wx * d[5],
          d[4] + wx * (d[1] - d[2]) + wz * d[5] - wy * d[3],
          d[5] + wy * (d[2] - d[0]) + wx * d[3] - wz * d[4]};
}

/// Velocity gradient: l_cj = rate_ci (F^-1)_ij in all lanes.
template<int L> MatLanes<L> velocity_gradient(const MatLanes<L>& rate, const Mat3& inverse_f) {
  MatLanes<L> l;
  for (int c = 0; c < 3; ++c)
    for (int j = 0; j < 3; ++j)
      l[c][j] = rate[c][0] * inverse_f[j] + rate[c][1] * inverse_f[3 + j] + rate[c][2] * inverse_f[6 + j];
  return l;
}

template<int L> SymLanes<L> symmetric_part(const MatLanes<L>& l) {
  return {l[0][0],
          l[1][1],
          l[2][2],
          0.5 * (l[0][1] + l[1][0]),
          0.5 * (l[1][2] + l[2][1]),
          0.5 * (l[0][2] + l[2][0])};
}

/// @param rate  sum_J v_c G_i over the neighbours, all lanes: rates of F with respect to the last refresh.
/// @param node  those of the node, which move its F.
/// @param start relative deformation at the beginning of the step.
template<int L, class Spin = double>
StepKinematics<L, Spin> step_kinematics(const MatLanes<L>& rate, const Mat3& node, const Mat3& start,
                                        double dt) {
  StepKinematics<L, Spin> k;
  Mat3 middle;
  for (int c = 0; c < 9; ++c) {
    middle[c] = start[c] + 0.5 * dt * node[c];
    k.end[c] = start[c] + dt * node[c];
  }
  Mat3 inverse_middle = inverse(middle);
  k.middle_factor = determinant(middle);
  k.volume_factor = determinant(k.end);
  for (double& x : inverse_middle) x *= dt;
  const MatLanes<L> l = velocity_gradient<L>(rate, inverse_middle);
  const auto spin = [&](int i, int j) -> Spin {
    const Lanes<double, L> w = 0.5 * (l[i][j] - l[j][i]);
    if constexpr (std::is_same_v<Spin, double>)
      return get_lane<L, double>(w, 0);
    else
      return w;
  };
  const Spin wx = spin(2, 1), wy = spin(0, 2), wz = spin(1, 0);
  k.rotation = cayley_rotation<Spin>(wx, wy, wz);
  // The strain is that of the middle of the step and has half of the step's rotation before it. Left out, a
  // rotation superposed on a loading would be exact to first order of the step only.
  k.increment = turn_slightly<Lanes<double, L>, Spin>(0.5 * wx, 0.5 * wy, 0.5 * wz, symmetric_part<L>(l));
  return k;
}

/// factor * s F^-T in all lanes: the stress that works on gradients taken at the last refresh. result[i][c]
/// multiplies the i-th derivative and gives the force along c.
template<int L> MatLanes<L> nominal_stress(const SymLanes<L>& s, const Mat3& deformation, double factor) {
  const Mat3 inverse_f = inverse(deformation);
  const MatLanes<L> full = {{{s[0], s[3], s[5]}, {s[3], s[1], s[4]}, {s[5], s[4], s[2]}}};
  MatLanes<L> p;
  for (int i = 0; i < 3; ++i)
    for (int c = 0; c < 3; ++c)
      p[i][c] = factor * (full[c][0] * inverse_f[3 * i] + full[c][1] * inverse_f[3 * i + 1] +
                          full[c][2] * inverse_f[3 * i + 2]);
  return p;
}

/// C : e in all lanes.
template<int L> SymLanes<L> apply(const Stiffness& tangent, const SymLanes<L>& e) {
  const Lanes<double, L> volume = e[0] + e[1] + e[2];
  Lanes<double, L> along{};
  for (int c = 0; c < 6; ++c) along += ((c < 3 ? 1.0 : 2.0) * tangent.direction[c]) * e[c];
  const Lanes<double, L> spherical = (tangent.bulk - 2.0 / 3 * tangent.shear) * volume;
  SymLanes<L> s;
  for (int c = 0; c < 6; ++c) {
    s[c] = 2 * tangent.shear * e[c] - (2 * tangent.flow * tangent.direction[c]) * along;
    if (c < 3) s[c] += spherical;
  }
  return s;
}

/// Scales deviator and mean of the moments (all lanes but 0) back to the limit.
template<int L> void hold_below(double limit, SymLanes<L>& stress) {
  const Lanes<double, L> mean = (stress[0] + stress[1] + stress[2]) / 3.0;
  Lanes<double, L> square{};
  for (int c = 0; c < 6; ++c) {
    const Lanes<double, L> s = c < 3 ? stress[c] - mean : stress[c];
    square += (c < 3 ? 1.5 : 3.0) * s * s;
  }
  Lanes<double, L> kept{}, mean_kept{};
  for (int m = 1; m < L; ++m) {
    kept[m] = square[m] > limit * limit ? limit / std::sqrt(square[m]) : 1;
    mean_kept[m] = std::fmin(limit, std::fmax(-limit, mean[m]));
  }
  for (int c = 0; c < 6; ++c) stress[c] = c < 3 ? kept * (stress[c] - mean) + mean_kept : kept * stress[c];
}

/// Rate law of the stress moments: all lanes but 0 gain weight * C : D_k dt with the material's tangent C
/// (Hillman and Chen 2016 with the tangent for the modulus), and are held below the strength the point has
/// left. Lane 0 is left undefined.
template<int L>
void add_moment_increment(SymLanes<L>& stress, const SymLanes<L>& increment, const Stiffness& tangent,
                          double weight) {
  const SymLanes<L> c_d = apply<L>(tangent, increment);
  for (int c = 0; c < 6; ++c) stress[c] += weight * c_d[c];
  if (!std::isinf(tangent.limit)) hold_below<L>(tangent.limit, stress);
}

} // namespace spall
