#pragma once

#include "micro/homogenization/energies.h"
#include "shared/damage_table.h"

namespace spall {

/// Damage of the unloaded cell: the stiffness that the initial crack costs, with the ligament intact, under
/// tension along the Voigt component `pull`.
double initial_damage(const CondensedCell& cell, int pull);

/// Appends one state to the curve of a cell pulled along the Voigt component `pull`, with everything that
/// can be known so far: work by the trapezoidal rule, secant damage (Eq. 27 with Eq. 29 at frozen cracks),
/// its renormalised form, and Eq. 29 taken literally along the path. The first state must be the unloaded
/// one.
void append_row(DamageCurve& curve, const InterfaceProblem& problem, const CellState& state, int pull);

/// Fills damage_strength, which needs the peak: 1 - stress / peak stress after the peak, 0 up to it. A stress
/// below `zero` (fraction of the peak) is what the solver's tolerance leaves of a broken cell's zero.
void set_strength_damage(DamageCurve& curve, double zero);

/// How well a curve obeys the two balances, as fractions of its largest psi.
struct EnergyChecks {
  double stress = 0; ///< |psi - stress * strain / 2|: holds to the solver's tolerance
  double work = 0;   ///< |work - dissipation - psi|: holds to the trapezoidal rule of the work
};
EnergyChecks check_energies(const DamageCurve& curve);

} // namespace spall
