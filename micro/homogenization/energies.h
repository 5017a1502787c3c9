#pragma once

#include "micro/equilibrium/interface_problem.h"

namespace spall {

/// Averages over the volume of the cell, cracks included.
template<int dim> struct HomogenizedState {
  Voigt<dim> stress = Voigt<dim>::Zero(); ///< homogenised stress, Pa
  double psi_bulk = 0;                    ///< (1/V) int sigma:e / 2 (Eq. 25 and Eq. 26, first term), J/m^3
  double psi_cohesive = 0;                ///< (1/V) int T.[[u]] / 2 (Eq. 26, second term), J/m^3
  double psi_undamaged = 0;               ///< energy of the uncracked cell at the same strain, J/m^3
  double dissipation = 0;                 ///< dissipated energy so far, J/m^3
  double opening = 0;                     ///< largest opening on the crack, m
  double psi() const { return psi_bulk + psi_cohesive; }
};

/// Computes the averages of a state. The printed Eq. 26 has u.h on the crack surface. It is interpreted as
/// one integral over the surface of the closing traction times the opening, both >= 0, because any other sign
/// or an integral over both faces would give damage above 1. This is the recoverable energy because unloading
/// follows the secant to the origin. psi_bulk is the condensed quadratic form of the bulk, psi_cohesive
/// follows from the law alone, and stress is the derivative of the bulk's energy with the strain. So psi =
/// stress:strain / 2 holds only in equilibrium and is a check, not a definition.
template<int dim>
HomogenizedState<dim> homogenize(const InterfaceProblem<dim>& problem, const CellState<dim>& state);

} // namespace spall
