#pragma once

#include "micro/homogenization/damage.h"
#include "micro/loading/macro_load.h"

namespace spall {

/// Returns Psi0+ and Psi0- of the uncracked cell at load 1, with zero stress in the free strain components,
/// J/m^3.
/// @param cell the cell before the free strain components were condensed out
template<int dim>
SplitEnergy undamaged_energy(const CondensedCell<dim>& cell, const MacroLoad<dim>& load,
                             double youngs_modulus, double poisson_ratio);

} // namespace spall
