#pragma once

#include "macro/points/tensor.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace spall {

/// Which directions cracks have.
enum class CrackModel {
  isotropic, ///< none: a crack takes the same share of stiffness and strength in all directions (Cracks)
  fixed,     ///< up to three at right angles, each normal to the principal stress that has opened it
  rotating   ///< always normal to the present principal stresses
};

/// Up to three cracks at right angles in one point: the smeared crack approach (Rots, Computational modeling
/// of concrete fracture, Delft 1988). SI units, tension positive, pressures compression positive.
///
/// The strain is that of the concrete between the cracks plus e1 n1 n1^T + e2 n2 n2^T + e3 n3 n3^T: the
/// openings e over the width of the point. A crack carries a tension of at most f, which falls as it opens,
/// and closes along the secant. With its largest opening E and the opening k at which its faces touch,
///
///   tension f (e - k) / (E - k) where e > k,      free energy f (e - k)^2 / (2 (E - k)).
///
/// A closed crack carries any pressure. So a crack takes tension and stiffness across itself alone. What is
/// pressed along it keeps its strength, and where it opens although the sides are pressed, the concrete
/// between the cracks is not strained with it.
///
/// Fixed cracks resist slip as they resist opening: an open one has the compliance c = (E - k) / f against
/// both, which leaves the share 1 / (1 + G (c_i + c_j)) of a shear stress. A crack that opens drops the rest,
/// one that closes keeps what there is: friction holds it, up to f + friction times the pressure across.
/// Rotating cracks never slip: their normals are the principal directions of the stress that would be there
/// without cracks. As these are no directions of the material, the three have one largest opening in common,
/// the widest, and nothing stays open. With a history for each, the free energy would depend on which history
/// a direction takes over where two principal stresses meet, and energy would appear there.
struct OrientedCracks {
  struct State {
    Mat3 normals = identity3;           ///< of the cracks, row by row
    Vec3 opening{}, largest{}, touch{}; ///< e, E, k
    Vec3 limit{};                       ///< f, Pa
    Vec3 damage{};                      ///< d_t of each
    Vec3 shear_share = {1, 1, 1};       ///< of the shear stresses between normals 1 and 2, 2 and 3, 3 and 1
    double fixed = 0;                   ///< how many normals a crack has fixed: 0, 1 or 3

    bool cracked() const { return largest[0] > 0 || largest[1] > 0 || largest[2] > 0; }
    bool open(std::size_t i) const { return opening[i] > touch[i]; }
    double total_opening() const { return opening[0] + opening[1] + opening[2]; }
    /// Opening over tension, c, 1/Pa; infinite if nothing is carried, 0 of a closed one.
    double compliance(std::size_t i) const;
  };

  CrackModel model = CrackModel::isotropic;
  double kept = 0;      ///< part of an opening that stays: k >= kept E (Cracks::opened_kept); of fixed cracks
  double dilatancy = 0; ///< opening over slip of rough faces (Cracks::dilatancy)
  double friction = 0;  ///< shear over normal stress at which faces that touch slip; of fixed cracks

  /// Deviator of the trial stress in the axes of the normals, Pa. Chooses the normals that are free: of fixed
  /// cracks those that no crack has fixed yet, of rotating ones all.
  /// @param before deviator before the strain of the step, turned with the point
  /// @param strain deviator of the step's strain  @param G shear modulus, Pa
  Sym3 trial(State& state, const Sym3& before, const Sym3& strain, double G) const;

  /// Opens and closes the cracks until none carries more than its limit, or less than nothing while it is
  /// open. Largest openings stay as they are. Returns the pressure and its modulus with the new openings.
  ///
  /// Given the sum of the openings, each opening follows from the stress across it by itself. So one equation
  /// is left, for the sum, which has one root: the openings that follow fall as the sum grows.
  /// @param s deviator in the axes of the normals, of the openings before; changed to that of those after, Pa
  /// @param press the sum of the openings -> pressure, Pa, and its modulus (Hydrostat::Response)
  /// @param G shear modulus of the concrete between the cracks, Pa
  template<class Press> auto move(State& state, Sym3& s, const Press& press, double G) const;

  /// Keeps the largest openings. Returns whether a crack has opened beyond that before.
  bool widen(State& state) const;

  /// After widen(): fixes normals, lets open cracks drop their share of the shear stress, and faces slip that
  /// friction does not hold. Returns the slip as an equivalent plastic strain. @param s, pressure after
  /// move()
  double settle(State& state, Sym3& s, double pressure, double G) const;

  /// Keeps open what rough faces that carry nothing and have slipped no longer close.
  /// @param strain of the step, in the axes of the normals
  void keep_open(State& state, const Sym3& strain) const;

  /// Free energy of the openings and slips, J/m^3. @param stress in the axes of the body, Pa
  static double energy(const State& state, const Sym3& stress, double G);
};

template<class Press> auto OrientedCracks::move(State& state, Sym3& s, const Press& press, double G) const {
  constexpr int most_turns = 100;
  constexpr double precise = 1e-13; // of the sum: about 0.01 Pa
  const double start = state.total_opening();
  const Vec3 before = state.opening;
  double low = state.touch[0] + state.touch[1] + state.touch[2],
         high = std::numeric_limits<double>::infinity();
  double sum = start;
  auto concrete = press(sum);
  for (int turn = 0; turn < most_turns; ++turn) {
    const double lift = 2. / 3 * G * (sum - start) - concrete.pressure;
    double follow = 0, slope = 0; // sum of the openings that follow; of their derivatives by the stress
    for (std::size_t i = 0; i < 3; ++i) {
      const double range = state.largest[i] - state.touch[i], f = state.limit[i],
                   tension = s[i] + lift + 2 * G * (before[i] - state.touch[i]); // if the faces just touched
      double gap = 0;
      if (tension > f + 2 * G * range) {
        gap = (tension - f) / (2 * G), slope += 1 / (2 * G);
      } else if (tension > 0 && range > 0) {
        const double softness = range / (f + 2 * G * range);
        gap = std::min(tension * softness, range), slope += softness;
      }
      state.opening[i] = state.touch[i] + gap;
      follow += state.opening[i];
    }
    const double excess = follow - sum;
    if (std::abs(excess) <= precise) break;
    (excess > 0 ? low : high) = sum;
    sum -= excess / (slope * (2. / 3 * G - concrete.modulus) - 1);
    if (!(sum > low && sum < high)) sum = (low + high) / 2;
    concrete = press(sum);
  }
  const Vec3 change = state.opening - before;
  const double mean = (change[0] + change[1] + change[2]) / 3;
  for (std::size_t i = 0; i < 3; ++i) s[i] -= 2 * G * (change[i] - mean);
  return concrete;
}

/// Normals of the principal directions of a symmetric tensor, row by row, descending principal values.
Mat3 principal_directions(const Sym3& a);

} // namespace spall
