#pragma once

#include "micro/loading/curve_tracing.h"
#include "micro/loading/macro_load.h"

#include <filesystem>

namespace spall {

/// Writes what a curve's rows hold beyond the damage table: how each row was controlled, all components of
/// macroscopic strain and stress (Pa), the free energy three ways (J/m^3: Eq. 26 integrated, half stress
/// times strain, work minus dissipation), damage of the tensile part of the energy (spectral split), the
/// lowest eigenvalue of the tangent's symmetric part (E / l) and the number of its own with negative real
/// part.
/// @param cell the cell before any strain was released
template<int dim>
void write_path(const InterfaceProblem<dim>& problem, const CondensedCell<dim>& cell,
                const MacroLoad<dim>& load, const CurveTrace<dim>& trace, const std::filesystem::path& file);

} // namespace spall
