#pragma once

#include "micro/loading/curve_tracing.h"
#include "micro/loading/macro_load.h"

#include <filesystem>

namespace spall {

/// Writes the data of a curve's rows that the damage table does not hold: the kind of step control, all
/// components of macroscopic strain and stress (Pa), the free energy computed in three ways (J/m^3: Eq. 26
/// integrated, half stress times strain, work minus dissipation), the damage of the tensile part of the
/// energy (spectral split), the lowest eigenvalue of the tangent's symmetric part (E / l), and the number of
/// eigenvalues of the tangent with a negative real part.
/// @param cell the cell before the free strain components were condensed out
template<int dim>
void write_path(const InterfaceProblem<dim>& problem, const CondensedCell<dim>& cell,
                const MacroLoad<dim>& load, const CurveTrace<dim>& trace, const std::filesystem::path& file);

} // namespace spall
