#pragma once

#include "macro/material/material.h"
#include "macro/points/points.h"

namespace spall {

/// Kinematics of one point over one step, for its gradient (lane 0) and the derivatives of the gradient
/// (lanes 1-3) at once. `rate[c][i]` = sum_J v_c G_i over the neighbours: rates of F with respect to the last
/// refresh.
struct StepKinematics {
  std::array<Lanes<double>, 6> increment; ///< D dt, midpoint (Hughes and Winget 1980), four lanes
  Mat3 rotation;                          ///< exp-like rotation of the step (Cayley of the spin)
  Mat3 end;                               ///< relative deformation at the end of the step
  double volume_factor;                   ///< det(end)
  double middle_factor;                   ///< det at midstep
};

/// @param start relative deformation at the beginning of the step.
inline StepKinematics step_kinematics(const std::array<std::array<Lanes<double>, 3>, 3>& rate,
                                      const Mat3& start, double dt) {
  StepKinematics k;
  Mat3 middle;
  for (int c = 0; c < 3; ++c)
    for (int i = 0; i < 3; ++i) {
      const double change = dt * rate[c][i][0];
      middle[3 * c + i] = start[3 * c + i] + 0.5 * change;
      k.end[3 * c + i] = start[3 * c + i] + change;
    }
  const Mat3 inverse_middle = inverse(middle);
  k.middle_factor = determinant(middle);
  k.volume_factor = determinant(k.end);
  // Velocity gradient times dt in all lanes: l_cj = rate_ci (F_mid^-1)_ij dt.
  std::array<std::array<Lanes<double>, 3>, 3> l;
  for (int c = 0; c < 3; ++c)
    for (int j = 0; j < 3; ++j)
      l[c][j] = (rate[c][0] * inverse_middle[j] + rate[c][1] * inverse_middle[3 + j] +
                 rate[c][2] * inverse_middle[6 + j]) *
                dt;
  k.increment = {l[0][0],
                 l[1][1],
                 l[2][2],
                 0.5 * (l[0][1] + l[1][0]),
                 0.5 * (l[1][2] + l[2][1]),
                 0.5 * (l[0][2] + l[2][0])};
  // Q = (1 - W/2)^-1 (1 + W/2) for the spin W with axial vector w: 1 + (W + W^2 / 2) / (1 + |w|^2 / 4).
  const double wx = 0.5 * (l[2][1][0] - l[1][2][0]), wy = 0.5 * (l[0][2][0] - l[2][0][0]),
               wz = 0.5 * (l[1][0][0] - l[0][1][0]);
  const double w2 = wx * wx + wy * wy + wz * wz, f = 1 / (1 + 0.25 * w2), h = 0.5 * f;
  k.rotation = {1 + h * (wx * wx - w2), h * wx * wy - f * wz,   h * wx * wz + f * wy,
                h * wx * wy + f * wz,   1 + h * (wy * wy - w2), h * wy * wz - f * wx,
                h * wx * wz - f * wy,   h * wy * wz + f * wx,   1 + h * (wz * wz - w2)};
  return k;
}

/// Q s Q^T in all lanes.
inline StressLanes rotate(const Mat3& q, const StressLanes& s) {
  const std::array<std::array<Lanes<double>, 3>, 3> full = {
      {{s[0], s[3], s[5]}, {s[3], s[1], s[4]}, {s[5], s[4], s[2]}}};
  std::array<std::array<Lanes<double>, 3>, 3> half;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      half[i][j] = q[3 * i] * full[0][j] + q[3 * i + 1] * full[1][j] + q[3 * i + 2] * full[2][j];
  const auto entry = [&](int i, int j) {
    return half[i][0] * q[3 * j] + half[i][1] * q[3 * j + 1] + half[i][2] * q[3 * j + 2];
  };
  return {entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(1, 2), entry(0, 2)};
}

/// factor * s F^-T in all lanes: the stress that works on gradients taken at the last refresh. result[i][c]
/// multiplies the i-th derivative and gives the force along c.
inline std::array<std::array<Lanes<double>, 3>, 3> nominal_stress(const StressLanes& s,
                                                                  const Mat3& deformation, double factor) {
  const Mat3 inverse_f = inverse(deformation);
  const std::array<std::array<Lanes<double>, 3>, 3> full = {
      {{s[0], s[3], s[5]}, {s[3], s[1], s[4]}, {s[5], s[4], s[2]}}};
  std::array<std::array<Lanes<double>, 3>, 3> p;
  for (int i = 0; i < 3; ++i)
    for (int c = 0; c < 3; ++c)
      p[i][c] = factor * (full[c][0] * inverse_f[3 * i] + full[c][1] * inverse_f[3 * i + 1] +
                          full[c][2] * inverse_f[3 * i + 2]);
  return p;
}

/// Scales deviator and mean of the moments (lanes 1-3) back to the limit.
inline void hold_below(double limit, StressLanes& stress) {
  const Lanes<double> mean = (stress[0] + stress[1] + stress[2]) / 3.0;
  Lanes<double> square{};
  for (int c = 0; c < 6; ++c) {
    const Lanes<double> s = c < 3 ? stress[c] - mean : stress[c];
    square += (c < 3 ? 1.5 : 3.0) * s * s;
  }
  Lanes<double> kept{}, mean_kept{};
  for (int m = 1; m < 4; ++m) {
    kept[m] = square[m] > limit * limit ? limit / std::sqrt(square[m]) : 1;
    mean_kept[m] = std::fmin(limit, std::fmax(-limit, mean[m]));
  }
  for (int c = 0; c < 6; ++c) stress[c] = c < 3 ? kept * (stress[c] - mean) + mean_kept : kept * stress[c];
}

/// Rate law of the stress moments: lanes 1-3 gain weight * C : D_k dt with the material's tangent C (Hillman
/// and Chen 2016 with the tangent for the modulus), and are held below the strength the point has left.
inline void add_moment_increment(StressLanes& stress, const std::array<Lanes<double>, 6>& increment,
                                 const Tangent& tangent, double weight) {
  const Lanes<double> volume = increment[0] + increment[1] + increment[2];
  Lanes<double> along{};
  for (int c = 0; c < 6; ++c) along += ((c < 3 ? 1.0 : 2.0) * tangent.direction[c]) * increment[c];
  const Lanes<double> spherical = (tangent.bulk - 2.0 / 3 * tangent.shear) * volume;
  for (int c = 0; c < 6; ++c) {
    Lanes<double> c_d = 2 * tangent.shear * increment[c] - (2 * tangent.flow * tangent.direction[c]) * along;
    if (c < 3) c_d += spherical;
    stress[c] += weight * c_d;
  }
  if (!std::isinf(tangent.limit)) hold_below(tangent.limit, stress);
}

} // namespace spall
