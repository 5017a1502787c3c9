#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace spall {

/// Friction of bodies that slide on each other: the tangential stress is at most
///
///   min(mu(v) p, tau_max),   mu(v) = mu_fast + (mu_rest - mu_fast) exp(-v / v_decay),
///
/// with the contact pressure p and the slip velocity v. The decay is that of explicit finite-element codes
/// (for example Benson and Hallquist 1990); with a largest stress friction no longer grows with the pressure,
/// because the softer face, or what has melted or been ground to powder there, shears at that stress.
struct Friction {
  double at_rest; ///< coefficient of bodies that begin to slide
  /// Coefficient at large slip velocities; NaN: the same as at rest.
  double sliding = std::numeric_limits<double>::quiet_NaN();
  /// Over which the difference falls to 1 / e, m/s. Needed with `sliding`.
  double decay_velocity = std::numeric_limits<double>::quiet_NaN();
  /// Largest tangential stress, Pa; NaN: none.
  double largest_stress = std::numeric_limits<double>::quiet_NaN();

  Friction(double coefficient = 0) : at_rest(coefficient) {}

  bool depends_on_velocity() const { return !std::isnan(sliding); }
  bool is_limited() const { return !std::isnan(largest_stress); }
  /// @param slip velocity, m/s
  double coefficient(double slip) const {
    return depends_on_velocity() ? std::lerp(sliding, at_rest, std::exp(-slip / decay_velocity)) : at_rest;
  }
  /// Returns the largest tangential impulse, N s.
  /// @param normal impulse, N s  @param slip velocity, m/s  @param face_dt area of the face times the step,
  /// m^2 s; only used if the stress is limited
  double largest_impulse(double normal, double slip, double face_dt) const {
    const double coulomb = coefficient(slip) * normal;
    return is_limited() ? std::min(coulomb, largest_stress * face_dt) : coulomb;
  }
};

} // namespace spall
