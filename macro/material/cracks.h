#pragma once

#include "macro/points/lane_math.h"
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
/// units, tension positive, pressures compression positive. V: one point or several (lane_math.h).
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
  /// Opening over slip where the faces of a rough crack touch again without pressure on them: a point that
  /// has no shear stiffness left and is sheared keeps that much of what it has opened. Cracks that still
  /// carry tension do not: the tests were made on cracks that had been broken before they slipped, and a kept
  /// volume that is pulled again would carry mean tension without any deviator.
  double dilatancy = 1.4;

  template<class V> struct StateOf {
    V opened = broadcast<V>(0);      ///< volumetric strain that has opened and stays
    V bulk_left = broadcast<V>(1);   ///< 1 - d+, of an open point
    V shear_left = broadcast<V>(1);  ///< 1 - d-, of an open point
    V shear_share = broadcast<V>(1); ///< share of s0 in the present deviator: shear_left if open, 1 if closed
  };

  /// What a point with little shear stiffness has is none: its s0 could no longer be told from round-off.
  static constexpr double least_shear_left = 1e-6;

  /// Mean tension of an open point: along the secant, up to the limit, Pa.
  /// @param sound mean tension K e of a sound point, Pa
  template<class V> static V mean_tension(const StateOf<V>& state, const V& sound, const V& limit) {
    return smaller(V(state.bulk_left * sound), limit);
  }

  /// Opens the cracks of a point whose tension exceeds the limit (Pa): it keeps a part of the opening and
  /// loses bulk modulus until its mean tension is the limit. Returns whether they have opened.
  /// @param open whether the point is open  @param strain volumetric strain e > 0 since the faces touched
  /// @param modulus K, Pa
  template<class V>
  Mask<V> open(StateOf<V>& state, const Mask<V>& open, const V& strain, const V& modulus,
               const V& limit) const {
    const V tension = state.bulk_left * modulus * strain;
    // A point without any strength left goes on opening at zero tension.
    const Mask<V> beyond = open & ((tension > limit) | ((tension == limit) & (limit == 0.)));
    if (opening == Opening::cut_off) return beyond;
    const V opened = state.opened + strain - limit / modulus;
    const V more = select(beyond, larger(0, V(opened_kept * opened - state.opened)), 0);
    state.opened += more;
    const V left = select(more < strain, smaller(1, V(limit / (modulus * (strain - more)))), 0);
    state.bulk_left = select(beyond, left, state.bulk_left);
    return beyond & ((tension > limit) | (more > 0.));
  }

  /// Slip of a crack band in a strain increment of equivalent strain `shape` and volume `widening`: a band
  /// that widens by w and slips by s, per width, has equivalent strain^2 = 4/9 w^2 + s^2 / 3.
  template<class V> static V slip(const V& shape, const V& widening) {
    return square_root(larger(0, V(3 * shape * shape - 4. / 3 * widening * widening)));
  }
  /// Keeps open what rough faces that have slipped no longer close, at constant mean tension.
  /// @param open whether the point is open and has no shear stiffness  @param strain its e
  template<class V>
  void keep_open(StateOf<V>& state, const Mask<V>& open, const V& strain, const V& slip) const {
    const V more = select(open, smaller(V((1 - state.bulk_left) * strain), V(dilatancy * slip)), 0);
    state.opened += more;
    state.bulk_left = select((more > 0.) & (more < strain),
                             smaller(1, V(state.bulk_left * strain / (strain - more))), state.bulk_left);
  }

  /// Share of s0 that remains when the strength leaves the share `factor` of the deviator: the rest stays as
  /// a change of shape.
  template<class V> V remaining_share(const V& factor) const { return 1 - opened_kept * (1 - factor); }
  /// Lets the share `factor` of the deviator of an open point remain. Returns the share of s0 that remains: a
  /// part of what is lost stays as a change of shape, the rest is lost stiffness.
  /// @param cracks whether the point is open and loses something
  template<class V> V shear(StateOf<V>& state, const Mask<V>& cracks, const V& factor) const {
    const V remaining = remaining_share(factor);
    V left = state.shear_left * select(remaining > 0., V(factor / remaining), 1);
    left = select(left < least_shear_left, 0, left);
    state.shear_left = select(cracks, left, state.shear_left);
    state.shear_share = select(cracks, left, state.shear_share);
    return remaining;
  }

  void declare(Parameters::Section& section);
};

} // namespace spall
