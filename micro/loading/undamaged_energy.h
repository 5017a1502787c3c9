#pragma once

#include "micro/homogenization/damage.h"
#include "micro/loading/macro_load.h"

namespace spall {

/// Psi0+ and Psi0- of the uncracked cell at load 1, its free strains relaxed, J/m^3.
/// @param cell the cell before any strain was released
template<int dim>
SplitEnergy undamaged_energy(const CondensedCell<dim>& cell, const MacroLoad<dim>& load,
                             double youngs_modulus, double poisson_ratio);

} // namespace spall
