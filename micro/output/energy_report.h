#pragma once

#include "micro/homogenization/damage.h"
#include "shared/summary.h"

namespace spall {

/// Prints how well the free energy computed in three ways agrees (integrated over bulk and cracks, half
/// stress times strain, work minus dissipation), with a caution if a difference exceeds its tolerance. The
/// same results are added to `summary`: energy_balance_error, psi_against_stress_error, their tolerances,
/// energy_checks_passed.
/// @param friction whether crack faces have friction; it stores no energy but contributes to the stress, so
/// that the second way does not apply
void report_energies(const EnergyChecks& checks, bool friction, Summary& summary);

} // namespace spall
