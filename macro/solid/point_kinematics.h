#pragma once

#include "macro/material/material.h"
#include "macro/points/tensor_lanes.h"

#include <cmath>
#include <type_traits>

namespace spall {

/// Kinematics of one point over one step, for all of its L gradient operators at once: one per lane.
/// Spin: double if all operators turn with the first one, Lanes<double, L> if each turns by its own spin.
template<int L, class Spin = double> struct StepKinematics {
  SymLanes<L> increment; ///< D dt of the middle of the step (Hughes and Winget 1980), turned to its end
  Mat<Spin> rotation;    ///< rotation over the step, the Cayley transform of the spin
  Mat3 end;              ///< relative deformation at the end of the step
  double volume_factor;  ///< det(end)
  double middle_factor;  ///< det of the relative deformation at midstep
};

/// Rotation matrix for the axial vector w of the spin times dt (Hughes and Winget 1980): with W v = w x v,
/// (1 - W/2)^-1 (1 + W/2) = 1 + (W + W^2 / 2) / (1 + |w|^2 / 4).
template<class V> Mat<V> cayley_rotation(const Vec<V>& w) {
  const auto& [x, y, z] = w;
  const V w2 = dot(w, w), f = 1 / (1 + 0.25 * w2), h = 0.5 * f;
  return {1 + h * (x * x - w2), h * x * y - f * z,    h * x * z + f * y,
          h * x * y + f * z,    1 + h * (y * y - w2), h * y * z - f * x,
          h * x * z - f * y,    h * y * z + f * x,    1 + h * (z * z - w2)};
}

/// d + W d - d W with W v = w x v: q d q^T to first order of the rotation, with the trace of d.
template<class V, class Spin> Sym<V> turn_slightly(const Vec<Spin>& w, const Sym<V>& d) {
  const V x = w[0] * d[4], y = w[1] * d[5], z = w[2] * d[3];
  return {d[0] + 2 * (y - z),
          d[1] + 2 * (z - x),
          d[2] + 2 * (x - y),
          d[3] + w[2] * (d[0] - d[1]) + w[1] * d[4] - w[0] * d[5],
          d[4] + w[0] * (d[1] - d[2]) + w[2] * d[5] - w[1] * d[3],
          d[5] + w[1] * (d[2] - d[0]) + w[0] * d[3] - w[2] * d[4]};
}

/// Objective strain increment and rotation of a step with constant velocities (Hughes and Winget 1980).
/// @param rate  sum_J v_J G_J^T over the neighbours for each operator: rates of F since the last refresh, 1/s
/// @param node  the same at the node, which moves its F
/// @param start relative deformation at the beginning of the step
template<int L, class Spin = double>
StepKinematics<L, Spin> step_kinematics(const MatLanes<L>& rate, const Mat3& node, const Mat3& start,
                                        double dt) {
  StepKinematics<L, Spin> k;
  const Mat3 middle = start + 0.5 * dt * node;
  k.end = start + dt * node;
  k.middle_factor = determinant(middle);
  k.volume_factor = determinant(k.end);
  const MatLanes<L> l_dt = multiply(rate, dt * inverse(middle)); // velocity gradient times dt
  const auto spin = [&] {
    const auto w = axial_vector(l_dt);
    if constexpr (std::is_same_v<Spin, double>)
      return lane<L>(w, 0);
    else
      return w;
  }();
  k.rotation = cayley_rotation(spin);
  // The strain is that of the middle of the step and has half of the step's rotation before it. Left out, a
  // rotation superposed on a loading would be exact to first order of the step only.
  k.increment = turn_slightly(0.5 * spin, symmetric_part(l_dt));
  return k;
}

/// factor * F^-1 s for each operator: the nominal stress, which does its work on gradients taken at the last
/// refresh (F: deformation since then). Component (i, c) multiplies the i-th derivative and gives the force
/// along c.
template<class V> Mat<V> nominal_stress(const Sym<V>& s, const Mat3& deformation, double factor) {
  return factor * multiply(inverse(deformation), full(s));
}

/// The stress C : e of a stiffness C (see Stiffness), Pa.
template<class V> Sym<V> apply(const Stiffness& stiffness, const Sym<V>& e) {
  const V along = contract_in_order(stiffness.direction, e);
  return plus_spherical(2 * stiffness.shear * e - 2 * stiffness.flow * stiffness.direction * along,
                        (stiffness.bulk - 2.0 / 3 * stiffness.shear) * trace(e));
}

/// Scales the stress moments (all lanes but 0) back to a limit, Pa, each by a factor of its own: the deviator
/// to that equivalent stress, and the mean stress to that magnitude. Lane 0 becomes zero.
template<int L> void hold_below(double limit, SymLanes<L>& stress) {
  const Lanes<double, L> mean = trace(stress) / 3.0;
  const SymLanes<L> s = deviator(stress);
  const Lanes<double, L> square = contract_in_order(1.5 * s, s); // square of the equivalent stress
  Lanes<double, L> return_factor{}, limited_mean{};
  for (int m = 1; m < L; ++m) {
    return_factor[m] = square[m] > limit * limit ? limit / std::sqrt(square[m]) : 1;
    limited_mean[m] = std::fmin(limit, std::fmax(-limit, mean[m]));
  }
  stress = plus_spherical(return_factor * s, limited_mean);
}

/// Rate law of the stress moments: all lanes but 0 gain weight * C : D_k dt with the material's stiffness C
/// (Hillman and Chen 2016, with it for the elastic modulus), and are held below the strength the point has
/// left. Lane 0 is left undefined.
template<int L>
void add_moment_increment(SymLanes<L>& stress, const SymLanes<L>& increment, const Stiffness& stiffness,
                          double weight) {
  stress += weight * apply(stiffness, increment);
  if (!std::isinf(stiffness.limit)) hold_below<L>(stiffness.limit, stress);
}

} // namespace spall
