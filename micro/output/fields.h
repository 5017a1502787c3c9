#pragma once

#include "micro/equilibrium/bulk.h"
#include "micro/loading/curve_tracing.h"

#include <filesystem>

namespace spall {

/// Returns the numbers of `count` rows evenly spaced along a curve (in strain over last strain and stress
/// over peak stress), including the first row, the peak of the stress and the last row; fewer if the curve is
/// shorter. For a count of 0 there is none, for 1 only the last row, for 2 the first and the last one.
std::vector<std::size_t> rows_to_show(const DamageCurve& curve, int count);

/// Writes fields.pvd and one fields_NNN.vtu per row into `directory`: displacement (m) and stress (Pa) of the
/// cell at its real size. The nodes on cracks are written twice, so that warping by the displacement shows
/// open cracks; every array carries its unit. The "time" of the series is the number of the row of curve.csv,
/// from 0: the strain is no time, because it decreases where the cell snaps back. The macroscopic strain
/// along problem.direction is the field data `macroscopic_strain` of each file.
/// @throws ComputationError if a file cannot be written.
template<int dim>
void write_fields(const Bulk<dim>& bulk, const InterfaceProblem<dim>& problem,
                  const std::vector<CellState<dim>>& states, const std::vector<std::size_t>& rows,
                  const std::filesystem::path& directory);

} // namespace spall
