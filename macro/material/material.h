#pragma once

#include "macro/points/lane_math.h"
#include "macro/points/tensor_lanes.h"

#include <array>
#include <bit>
#include <cstring>
#include <limits>

namespace spall {

/// What one material point is told about a time step. Strains and stresses: tension positive.
/// V: double for one point; Lanes<double, L> for several. Of: double if these share all but the increment,
/// as the sub-points of a cell do; V if each is a point of its own.
template<class V, class Of = double> struct StrainStepOf {
  Sym<V> increment; ///< midpoint strain increment D dt (Hughes-Winget; the stress has been rotated already)
  double dt;        ///< s
  Of volume_ratio;  ///< J = det F at the end of the step
  const Mat<Of>& deformation; ///< F at the end of the step
  Of spacing = Of{}; ///< edge of the cell the point stands for, m: laws that soften are resized to it
  /// Distance from the axis of rotational symmetry, m, where yy is the hoop direction; 0: no such symmetry.
  Of radius = Of{};
  /// Rotation over the step, for what a law remembers in axes of space; none: no rotation.
  const Mat<V>* rotation = nullptr;
  /// Part of the increment's trace that is not in the volume ratio: of a sub-point that has a volume of its
  /// own.
  V swelling = broadcast<V>(0);
};
using StrainStep = StrainStepOf<double>;

/// Stiffness of a material point against a small change of strain e, in the form
///   C : e = bulk tr(e) 1 + 2 shear dev(e) - 2 flow n (n : e),  n a unit deviator (n : n = 1), moduli in Pa.
///
/// A law's `elastic` returns its elastic moduli (flow = 0), for the critical time step. Its `update` returns
/// the stiffness that the stabilisation of the step may use. That is not always the derivative of the stress:
/// it is for J2 (the consistent tangent), and it is not for Afc, whose derivative is not symmetric and, where
/// the concrete softens, not positive.
template<class V> struct StiffnessOf {
  V bulk = broadcast<V>(0), shear = broadcast<V>(0), flow = broadcast<V>(0);
  Sym<V> direction{}; ///< n
  /// Largest equivalent stress and largest mean stress that a stress moment may hold, Pa: a crushed or
  /// cracked point must not be held together, or pushed apart, by its stabilisation. Infinite for materials
  /// that do not lose strength.
  V limit = broadcast<V>(std::numeric_limits<double>::infinity());

  /// C : e
  Sym<V> operator()(const Sym<V>& e) const {
    const Sym<V> s = deviator(e);
    const V volume = bulk * trace(e), along = 2 * flow * contract(direction, s);
    return plus_spherical(2 * shear * s - along * direction, volume);
  }
};
using Stiffness = StiffnessOf<double>;

/// The state of one of several points side by side. StateOf<V> consists of numbers V.
template<int L, template<class> class StateOf>
StateOf<double> state_in_lane(const StateOf<Lanes<double, L>>& states, int m) {
  constexpr std::size_t count = sizeof(StateOf<double>) / sizeof(double);
  static_assert(sizeof(states) == L * sizeof(StateOf<double>));
  std::array<double, L * count> all;
  std::array<double, count> one;
  std::memcpy(all.data(), &states, sizeof states);
  for (std::size_t k = 0; k < count; ++k) one[k] = all[k * L + static_cast<std::size_t>(m)];
  return std::bit_cast<StateOf<double>>(one);
}

/// Free energy of a material point, J/m^3: all that it can ever give back. In the mean stress and in the
/// deviator.
struct StoredEnergy {
  double volume = 0, shape = 0;
  double total() const { return volume + shape; }
};

/// A history variable of a law, for output.
template<class State> struct HistoryField {
  const char* name;
  double State::*value;
  const char* unit; ///< SI; "1": none
};

/// Young's modulus and Poisson's ratio of an isotropic material with bulk modulus K and shear modulus G.
inline double youngs_modulus_of(double K, double G) { return 9 * K * G / (3 * K + G); }
inline double poisson_ratio_of(double K, double G) { return (3 * K - 2 * G) / (2 * (3 * K + G)); }

} // namespace spall
