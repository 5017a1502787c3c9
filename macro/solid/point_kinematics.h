#pragma once

#include "macro/material/material.h"
#include "macro/points/tensor_lanes.h"

#include <array>
#include <limits>

namespace spall {

/// Kinematics of one step of a node and its gradient operators, for one node or several side by side.
/// V: a number of each node. W: a number of each operator, double or lanes. There are N of them: either one W
/// holds a number of all operators of one node, or W is V and there is one for each operator.
template<class W, class V, int N> struct StepKinematics {
  /// D dt of the middle of the step (Hughes and Winget 1980), turned to its end.
  std::array<Sym<W>, N> increment;
  Mat<W> rotation; ///< rotation over the step, the Cayley transform of the spin
  Mat<V> end;      ///< relative deformation at the end of the step
  V volume_factor; ///< det(end)
  V middle_factor; ///< det of the relative deformation at midstep
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

/// Objective strain increments and rotation of a step with constant velocities (Hughes and Winget 1980). All
/// operators turn with the first of the N, so each by its own spin if one W holds them all.
/// @param rates sum_J v_J G_J^T over the neighbours for each operator: rates of F since the last refresh, 1/s
/// @param node  the same at the node, which moves its F
/// @param start relative deformation at the beginning of the step
template<class W, class V, std::size_t N>
StepKinematics<W, V, N> step_kinematics(const std::array<Mat<W>, N>& rates, const Mat<V>& node,
                                        const Mat<V>& start, double dt) {
  StepKinematics<W, V, N> k;
  const Mat<V> middle = start + 0.5 * dt * node;
  k.end = start + dt * node;
  k.middle_factor = determinant(middle);
  k.volume_factor = determinant(k.end);
  const Mat<V> to_middle = dt * inverse(middle);
  // The velocity gradient times dt.
  const auto l_dt = [&](std::size_t m) { return multiply(rates[m], to_middle); };
  const Vec<W> spin = axial_vector(l_dt(0));
  k.rotation = cayley_rotation(spin);
  // The strain is that of the middle of the step and has half of the step's rotation before it. Left out, a
  // rotation superposed on a loading would be exact to first order of the step only.
  for (std::size_t m = 0; m < N; ++m) k.increment[m] = turn_slightly(0.5 * spin, symmetric_part(l_dt(m)));
  return k;
}

/// factor * F^-1 s for each operator: the nominal stress, which does its work on gradients taken at the last
/// refresh (F: deformation since then). Component (i, c) multiplies the i-th derivative and gives the force
/// along c.
template<class W, class V>
Mat<W> nominal_stress(const Sym<W>& s, const Mat<V>& deformation, const V& factor) {
  return factor * multiply(inverse(deformation), full(s));
}

/// The stress C : e of a stiffness C (see Stiffness), Pa.
template<class V, class W> Sym<W> apply(const StiffnessOf<V>& stiffness, const Sym<W>& e) {
  const W along = contract_in_order(stiffness.direction, e);
  return plus_spherical(2 * stiffness.shear * e - 2 * stiffness.flow * stiffness.direction * along,
                        (stiffness.bulk - 2.0 / 3 * stiffness.shear) * trace(e));
}

/// Scales a stress moment back to a limit, Pa: the deviator to that equivalent stress, and the mean stress to
/// that magnitude.
template<class V> Sym<V> held_below(const V& limit, const Sym<V>& stress) {
  const V mean = trace(stress) / 3.0;
  const Sym<V> s = deviator(stress);
  const V square = contract_in_order(1.5 * s, s); // square of the equivalent stress
  const V return_factor = select(square > limit * limit, limit / square_root(square), 1);
  return plus_spherical(return_factor * s, smaller(limit, larger(V(-limit), mean)));
}

/// Rate law of a stress moment: it gains weight * C : D_k dt with the material's stiffness C (Hillman and
/// Chen 2016, with it for the elastic modulus), and is held below the strength the point has left. Returns
/// the moment at the end of the step, Pa.
template<class V>
Sym<V> advance_moment(const Sym<V>& stress, const Sym<V>& increment, const StiffnessOf<V>& stiffness,
                      double weight) {
  const Sym<V> grown = stress + weight * apply(stiffness, increment);
  const bool limited = any(stiffness.limit < std::numeric_limits<double>::infinity());
  return limited ? held_below(stiffness.limit, grown) : grown;
}

} // namespace spall
