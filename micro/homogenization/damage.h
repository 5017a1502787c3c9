#pragma once

#include "micro/homogenization/energies.h"
#include "shared/damage_table.h"

#include <cmath>

namespace spall {

/// Damage of the unloaded cell: the stiffness that the initial cracks cost, with the ligaments intact, under
/// strain along problem.direction. Where that presses a crack's faces on each other they carry.
template<int dim> double initial_damage(const InterfaceProblem<dim>& problem);

/// Appends one state to the curve of a cell strained along problem.direction, with everything that can be
/// known so far: work by the trapezoidal rule, secant damage (Eq. 27 with Eq. 29 at frozen cracks), its
/// renormalised form, and Eq. 29 taken literally along the path. Strain is the multiple of the direction,
/// stress its work-conjugate: for uniaxial strain the stress along the pull. The first state must be the
/// unloaded one.
template<int dim>
void append_row(DamageCurve& curve, const InterfaceProblem<dim>& problem, const CellState<dim>& state);

/// Energy of the uncracked cell at a strain, for Young's modulus 1, split by the signs of the principal
/// strains and of the volume change (Psi0+ and Psi0- of Eq. 28).
struct SplitEnergy {
  double plus = 0, minus = 0;
};
template<int dim> SplitEnergy spectral_split(const Voigt<dim>& strain, double poisson_ratio);

/// Damage of the tensile part of the energy: psi = (1 - d) Psi0+ + Psi0-. 0 where Psi0+ is 0.
double damage_plus(double psi, const SplitEnergy& undamaged);

/// Fills psi_undamaged_plus, psi_undamaged_minus and damage_plus. `unit` is the split energy of the uncracked
/// cell at strain 1, J/m^3; under reversed strain its parts change places. At strain 0, where there is
/// nothing to divide by, damage_plus is the limit that belongs to the damage of that row. Where compression
/// is part of the load damage_plus may leave [0, 1]: cracks can release energy of Psi0-.
void set_damage_plus(DamageCurve& curve, const SplitEnergy& unit);

/// Fills damage_strength, which needs the peak: 1 - stress / peak stress after the peak, 0 up to it. A stress
/// below `zero` (fraction of the peak) is what the solver's tolerance leaves of a broken cell's zero.
void set_strength_damage(DamageCurve& curve, double zero);

/// The virgin curve as a table can hold it, strain strictly increasing: rows on or below a strain reached
/// before (snap-back, unloading, reloading) are left out. Where the curve comes back from a snap-back, a row
/// just above the strain it left at holds the state it comes back to, so that the drop is as sharp as strain
/// control would see it; energies stay those of the path. Damage keeps its largest value so far, also where
/// fragments that wedge stiffen the cell again. Columns not filled yet stay empty.
DamageCurve envelope(const DamageCurve& curve);

/// How well a curve obeys the two balances, as fractions of its largest psi, and what is allowed.
struct EnergyChecks {
  /// Measured: 1e-14 to 1e-9, from the tolerance 1e-9 of the tractions.
  static constexpr double stress_tolerance = 1e-6;
  /// Measured at the default steps: 1e-5 for one crack, up to 4e-4 among random cells; the error of the
  /// trapezoidal rule falls with the square of the step.
  static constexpr double work_tolerance = 1e-3;
  double stress = 0; ///< |psi - stress * strain / 2|: holds to the solver's tolerance (but not with friction)
  double work = 0;   ///< |work - dissipation - psi|: holds to the trapezoidal rule of the work
  /// Keeps the larger error of this and of one more row or curve. Not a number is the largest error of all.
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
