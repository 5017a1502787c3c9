#pragma once

#include "micro/equilibrium/bulk.h"
#include "micro/loading/curve_tracing.h"

#include <filesystem>

namespace spall {

/// Rows of a curve spread evenly along it (in strain over last strain, stress over peak stress), the first,
/// the peak of the stress and the last among them: `count` of them, fewer if the curve is shorter; none for
/// 0, the last for 1, the ends for 2.
std::vector<std::size_t> rows_to_show(const DamageCurve& curve, int count);

/// Writes fields.pvd and one fields_NNN.vtu per row into `directory`: displacement (m) and stress (Pa) of the
/// cell at its real size. The nodes on cracks are there twice, so warping by the displacement shows the
/// crack open. The "time" of the series is the macroscopic strain along problem.direction.
/// @throws ComputationError if a file cannot be written.
template<int dim>
void write_fields(const Bulk<dim>& bulk, const InterfaceProblem<dim>& problem,
                  const std::vector<CellState<dim>>& states, const std::vector<std::size_t>& rows,
                  const std::filesystem::path& directory);

} // namespace spall
