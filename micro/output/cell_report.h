#pragma once

#include "micro/loading/curve_tracing.h"
#include "shared/summary.h"

namespace spall {

/// What the curve of the reference size says, for summary.json: strength, energies, stability, events.
template<int dim>
void summarise(Summary& summary, const CurveTrace<dim>& trace, const InterfaceProblem<dim>& problem);

/// Where the cracks ran in a cell of aggregates: the lengths of fully broken crack, m, that would have
/// dissipated the same energy, in the interface zones and in the mortar.
/// @param aggregates number of aggregates: crack lines of lower numbers are interface zones
template<int dim>
void summarise_paths(Summary& summary, const InterfaceProblem<dim>& problem, const CellState<dim>& state,
                     std::size_t aggregates);

/// One line on standard output per cell size.
void print_curve(const DamageCurve& curve, double seconds);

/// Says on standard output where the path branched or snapped back: neither is passed in silence.
void print_events(const std::vector<CurveEvent>& events);

} // namespace spall
