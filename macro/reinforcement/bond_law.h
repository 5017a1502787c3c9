#pragma once

#include "macro/points/tensor.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace spall {

enum class BondKind {
  rigid, ///< elastic, and never fails: the bar goes with the concrete
  slip   ///< ribs shear the concrete off, and the bar presses into it
};

/// What a node of a bar remembers of its bond. Forces per length of the bar act on the bar, N/m.
struct BondState {
  double along = 0;        ///< along the bar
  Vec3 across{};           ///< across it
  double slip = 0;         ///< of the bar against the concrete, m
  double largest_slip = 0; ///< largest magnitude of it so far, m
};

/// Force between a bar and the concrete around it, per length of the bar.
///
/// Both kinds have an elastic stiffness k along and across the bar. A load along a bar of radius r is carried
/// by the shear of the concrete around it: within a radius R it moves by q ln(R / r) / (2 pi G) (shear lag:
/// Cox 1952; Randolph and Wroth 1978), so k = 2 pi G / ln(R / r), with the radius R over which the points
/// average the displacement. Where bars are so thick that R < e r, k = 2 pi G.
///
/// Slip: along the bar the bond stress has the limit of the fib Model Code 2010, section 6.1.1 (Table 6.1-1,
/// pull-out, good bond): tau_max = 2.5 MPa sqrt(f_cm / MPa), which grows with (s / s1)^0.4 to s1 = 1 mm,
/// stays to s2 = 2 mm and falls linearly to 0.4 tau_max at s3, the distance of the ribs. Across the bar the
/// concrete bears at most n f_cm d. The factor n follows from the strength of a dowel, 1.3 d^2 sqrt(f_y f_cm)
/// (Rasmussen 1963): with the plastic moment d^3 f_y / 6 a bar that presses with n f_cm d carries
/// d^2 sqrt(n f_y f_cm / 3), so n = 3 * 1.3^2.
struct BondLaw {
  static constexpr double unset = std::numeric_limits<double>::quiet_NaN();
  BondKind kind = BondKind::rigid;
  double stiffness = unset;         ///< k: force per length and per relative displacement, Pa
  double concrete_strength = unset; ///< f_cm: mean strength of cylinders in compression, Pa; of slip
  double rib_spacing = unset;       ///< s3: clear distance between the ribs, m; of slip

  static constexpr double first_slip = 1e-3, second_slip = 2e-3; ///< s1, s2, m
  static constexpr double rising_power = 0.4, residual_part = 0.4;
  static constexpr double bearing_factor = 3 * 1.3 * 1.3; ///< n

  /// k for a bar of radius r in concrete of shear modulus G (Pa) whose points average over R, m.
  static double elastic_stiffness(double shear_modulus, double bar_radius, double average_radius) {
    return 2 * std::numbers::pi * shear_modulus / std::max(1.0, std::log(average_radius / bar_radius));
  }
  /// Largest bond stress after a slip (magnitude, m), Pa.
  double largest_stress(double slip) const {
    const double most = 2.5e6 * std::sqrt(concrete_strength / 1e6);
    if (slip < first_slip) return most * std::pow(slip / first_slip, rising_power);
    if (slip < second_slip) return most;
    if (slip < rib_spacing)
      return most * (1 - (1 - residual_part) * (slip - second_slip) / (rib_spacing - second_slip));
    return residual_part * most;
  }
  /// Takes the state over a relative displacement of the bar, along and across it, m.
  void advance(BondState& state, double along, const Vec3& across, double diameter) const {
    state.slip += along;
    state.largest_slip = std::max(state.largest_slip, std::abs(state.slip));
    state.along -= stiffness * along;
    state.across -= stiffness * across;
    if (kind == BondKind::rigid) return;
    const double limit = std::numbers::pi * diameter * largest_stress(state.largest_slip);
    state.along = std::clamp(state.along, -limit, limit);
    const double most = bearing_factor * concrete_strength * diameter, size = norm(state.across);
    if (size > most) state.across *= most / size;
  }
};

} // namespace spall
