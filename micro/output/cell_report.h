#pragma once

#include "micro/loading/curve_tracing.h"
#include "shared/summary.h"

namespace spall {

/// Adds the results of the reference size's curve to summary.json: strength, energies, stability, events.
template<int dim>
void summarise(Summary& summary, const CurveTrace<dim>& trace, const InterfaceProblem<dim>& problem);

/// Adds the crack lengths in the interface zones and in the mortar of a cell with aggregates to the summary:
/// the lengths of fully broken crack, m, that would have dissipated the same energy.
/// @param aggregates number of aggregates: crack lines of lower numbers are interface zones
template<int dim>
void summarise_paths(Summary& summary, const InterfaceProblem<dim>& problem, const CellState<dim>& state,
                     std::size_t aggregates);

/// Prints the main results of a cell size in one line on standard output.
void print_curve(const DamageCurve& curve, double seconds);

/// Prints on standard output where the path branched or snapped back.
void print_events(const std::vector<CurveEvent>& events);

} // namespace spall
