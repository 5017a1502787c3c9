#pragma once

#include "micro/homogenization/energies.h"
#include "shared/damage_table.h"

#include <cmath>

namespace spall {

/// Returns the damage of the unloaded cell: the relative loss of stiffness by the initial cracks, with intact
/// ligaments, under strain along problem.direction. Crack faces that this strain presses on each other
/// transmit the pressure.
template<int dim> double initial_damage(const InterfaceProblem<dim>& problem);

/// Appends one state to the curve of a cell strained along problem.direction and fills all columns that do
/// not need later rows: work by the trapezoidal rule, secant damage (Eq. 27 with Eq. 29 at frozen cracks),
/// its renormalised form, and Eq. 29 taken literally along the path. Strain is the multiple of the direction
/// and stress its work conjugate; for uniaxial strain this is the stress along the tension axis. The first
/// state must be the unloaded one.
template<int dim>
void append_row(DamageCurve& curve, const InterfaceProblem<dim>& problem, const CellState<dim>& state);

/// Strain energy of the uncracked cell for Young's modulus 1, split by the signs of the principal strains and
/// of the volume change (Psi0+ and Psi0- of Eq. 28).
struct SplitEnergy {
  double plus = 0, minus = 0;
};
template<int dim> SplitEnergy spectral_split(const Voigt<dim>& strain, double poisson_ratio);

/// Returns the damage d of the tensile part of the energy from psi = (1 - d) Psi0+ + Psi0-; 0 where Psi0+ is
/// 0.
double damage_plus(double psi, const SplitEnergy& undamaged);

/// Fills psi_undamaged_plus, psi_undamaged_minus and damage_plus. `unit` is the split energy of the uncracked
/// cell at strain 1, J/m^3; under reversed strain its two parts are exchanged. At strain 0 the quotient is
/// undefined, and damage_plus is the limit that belongs to the damage of that row. If the load includes
/// compression, damage_plus may leave [0, 1], because cracks can release energy of Psi0-.
void set_damage_plus(DamageCurve& curve, const SplitEnergy& unit);

/// Fills damage_strength, which needs the peak: 1 - stress / peak stress after the peak, 0 up to it. A stress
/// below `zero` (a fraction of the peak) counts as zero: the solver's tolerance leaves such a stress in a
/// broken cell.
void set_strength_damage(DamageCurve& curve, double zero);

/// Returns the envelope of a curve with strictly increasing strain, as a damage table needs it. Rows at or
/// below a strain that was reached before (snap-back, unloading, reloading) are left out. After a snap-back,
/// a row just above the strain at which it began holds the state at which the path returns to that strain, so
/// that the stress drop is as steep as under strain control; energies remain those of the path. Damage keeps
/// its largest value so far, even where jammed fragments make the cell stiffer again. Columns that are not
/// filled yet stay empty.
DamageCurve envelope(const DamageCurve& curve);

/// Errors of the two energy balances of a curve, as fractions of its largest psi, and their tolerances.
struct EnergyChecks {
  /// Tolerance of `stress`. Measured errors are 1e-14 to 1e-9, from the tolerance 1e-9 of the tractions.
  static constexpr double stress_tolerance = 1e-6;
  /// Tolerance of `work`. Measured errors at the default steps are 1e-5 for one crack and up to 4e-4 for
  /// random cells; the error of the trapezoidal rule falls with the square of the step.
  static constexpr double work_tolerance = 1e-3;
  double stress = 0; ///< |psi - stress * strain / 2|: zero up to the solver's tolerance, except with friction
  double work = 0;   ///< |work - dissipation - psi|: zero up to the error of the work's trapezoidal rule
  /// Takes the maximum of these errors and those of one more row or curve. NaN counts as larger than any
  /// number.
  void include(double stress_error, double work_error) {
    stress = larger(stress, stress_error);
    work = larger(work, work_error);
  }
  void include(const DamageCurve& curve) { include(curve.psi_stress_error, curve.psi_work_error); }

private:
  static double larger(double a, double b) { return std::isnan(a) || a > b ? a : b; }
};
EnergyChecks check_energies(const DamageCurve& curve);

} // namespace spall
