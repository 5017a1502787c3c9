#pragma once

#include "shared/input/parameters.h"

#include <algorithm>
#include <cmath>

namespace spall {

/// What a point does that is pulled beyond the limit of its mean tension.
enum class Opening {
  /// It loses stiffness, and closes along the secant (Cracks).
  cracks,
  /// Pressure cut-off, as in most programs for impact: the mean stress stays at the limit while the volume
  /// grows, and closes along the line on which it opened; the deviator keeps its stiffness and flows. What
  /// opening has cost is given back: for verification against such programs.
  cut_off
};

/// Cracks of a point: what they leave of its stiffness in tension, how they open and how they close. SI
/// units, tension positive, pressures compression positive.
///
/// Free energy per volume with the two scalars of Eq. 27: an open point has lost the share d+ of its bulk
/// modulus and d- of its shear modulus, a closed one nothing.
///
///   open, e > 0:   Psi = (1 - d+) K e^2 / 2 + (1 - d-) s0 : s0 / (4 G)
///   closed:        Psi = P^2 / (2 K)        +           s0 : s0 / (4 G)
///
/// e is the volumetric strain since the faces of the cracks touched, s0 the deviator of a sound point, K the
/// bulk modulus of unloading. The stress is the derivative: mean stress (1 - d+) K e and deviator (1 - d-)
/// s0, the secant towards the touching of the faces. The strength of Eq. 30 decides how large the damages
/// are: what exceeds the limit of mean tension raises d+, what exceeds the strength at the present mean
/// stress raises d-. Both are losses of stiffness; d_t, the loss of strength, is a third quantity
/// (TensileDamage).
///
/// Nothing is given back but Psi. It falls, without work, in these ways alone:
/// - a damage grows at constant strain: by its Y of Eq. 28, K e^2 / 2 or s0 : s0 / (4 G);
/// - a part of the opening or of the change of shape stays for good: e or s0 falls;
/// - the point opens: s0 stays and the deviator drops to (1 - d-) s0, since an open crack carries no shear;
/// - the point closes: the deviator stays and becomes s0, since friction holds the faces where they touch.
struct Cracks {
  Opening opening = Opening::cracks;
  /// Part of the volume opened beyond the limit, and of the change of shape beyond the strength, that stays,
  /// because the pieces no longer fit: 0, a point closes like the crack of the microcell before it carries
  /// pressure again; 1, no stiffness is lost, and pressure returns at once (plastic flow).
  double opened_kept = 0.1;
  /// Opening over slip where the faces of a rough crack touch again without pressure on them: an open point
  /// that is sheared keeps that much of what it has opened.
  double dilatancy = 1.4;

  struct State {
    double opened = 0;      ///< volumetric strain that has opened and stays
    double bulk_left = 1;   ///< 1 - d+, of an open point
    double shear_left = 1;  ///< 1 - d-, of an open point
    double shear_share = 1; ///< share of s0 in the present deviator: shear_left if open, 1 if closed
  };

  /// What a point with little shear stiffness has is none: its s0 could no longer be told from round-off.
  static constexpr double least_shear_left = 1e-6;

  /// Mean tension of an open point: along the secant, up to the limit, Pa.
  /// @param sound mean tension K e of a sound point, Pa
  static double mean_tension(const State& state, double sound, double limit) {
    return std::min(state.bulk_left * sound, limit);
  }

  /// Opens the cracks of a point whose tension exceeds the limit (Pa): it keeps a part of the opening and
  /// loses bulk modulus until its mean tension is the limit. Returns whether they have opened.
  /// @param strain volumetric strain e > 0 since the faces touched, @param modulus K, Pa
  bool open(State& state, double strain, double modulus, double limit) const {
    const double tension = state.bulk_left * modulus * strain;
    // A point without any strength left goes on opening at zero tension.
    if (!(tension > limit || (tension == limit && limit == 0))) return false;
    if (opening == Opening::cut_off) return true;
    const double opened = state.opened + strain - limit / modulus;
    const double more = std::max(0.0, opened_kept * opened - state.opened);
    state.opened += more;
    state.bulk_left = more < strain ? std::min(1.0, limit / (modulus * (strain - more))) : 0;
    return tension > limit || more > 0;
  }

  /// Slip of a crack band in a strain increment of equivalent strain `shape` and volume `widening`: a band
  /// that widens by w and slips by s, per width, has equivalent strain^2 = 4/9 w^2 + s^2 / 3.
  static double slip(double shape, double widening) {
    return std::sqrt(std::max(0.0, 3 * shape * shape - 4. / 3 * widening * widening));
  }
  /// Keeps open what rough faces that have slipped no longer close, at constant mean tension.
  /// @param strain e of the open point
  void keep_open(State& state, double strain, double slip) const {
    const double more = std::min((1 - state.bulk_left) * strain, dilatancy * slip);
    state.opened += more;
    if (more > 0 && more < strain)
      state.bulk_left = std::min(1.0, state.bulk_left * strain / (strain - more));
  }

  /// Share of s0 that remains when the strength leaves the share `factor` of the deviator: the rest stays as
  /// a change of shape.
  double remaining_share(double factor) const { return 1 - opened_kept * (1 - factor); }
  /// Lets the share `factor` of the deviator of an open point remain. Returns the share of s0 that remains: a
  /// part of what is lost stays as a change of shape, the rest is lost stiffness.
  double shear(State& state, double factor) const {
    const double remaining = remaining_share(factor);
    if (remaining > 0) state.shear_left *= factor / remaining;
    if (state.shear_left < least_shear_left) state.shear_left = 0;
    state.shear_share = state.shear_left;
    return remaining;
  }

  void declare(Parameters::Section& section);
};

} // namespace spall
