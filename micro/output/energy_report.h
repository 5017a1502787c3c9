#pragma once

#include "micro/homogenization/damage.h"
#include "shared/summary.h"

namespace spall {

/// Says on standard output how well the free energy agrees with itself computed three ways (integrated over
/// bulk and cracks, half stress times strain, work minus dissipation), and cautions where that is not within
/// the tolerance. The same goes into `summary`: energy_balance_error, psi_against_stress_error, their
/// tolerances, energy_checks_passed.
/// @param friction between crack faces stores no energy but is part of the stress: the second way then does
/// not apply
void report_energies(const EnergyChecks& checks, bool friction, Summary& summary);

} // namespace spall
