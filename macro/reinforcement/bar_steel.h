#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace spall {

/// What a segment of a bar remembers.
struct SteelState {
  double stress = 0;         ///< force over the initial section, tension positive, Pa
  double plastic_strain = 0; ///< present
  double accumulated = 0;    ///< sum of its magnitudes
};

/// The steel of a reinforcing bar in one dimension: J2 plasticity with isotropic linear hardening, of the
/// nominal stress over the nominal strain (l - l0) / l0, as bars are tested. A segment ruptures when its
/// accumulated plastic strain reaches the rupture strain: in tension it necks, in compression it buckles.
struct BarSteel {
  static constexpr double unset = std::numeric_limits<double>::quiet_NaN();
  double youngs_modulus = unset;    ///< Pa
  double yield_stress = unset;      ///< Pa
  double hardening_modulus = unset; ///< stress per plastic strain, Pa
  double rupture_strain = unset;    ///< accumulated plastic strain
  double density = unset;           ///< kg/m^3

  bool ruptured(const SteelState& state) const { return state.accumulated >= rupture_strain; }
  /// Takes the state to a nominal strain.
  void advance(SteelState& state, double strain) const {
    if (ruptured(state)) return;
    const double trial = youngs_modulus * (strain - state.plastic_strain);
    const double excess = std::abs(trial) - yield_stress - hardening_modulus * state.accumulated;
    const double flow = std::max(0.0, excess / (youngs_modulus + hardening_modulus));
    state.plastic_strain += std::copysign(flow, trial);
    state.accumulated += flow;
    state.stress = ruptured(state) ? 0 : trial - youngs_modulus * std::copysign(flow, trial);
  }
};

} // namespace spall
