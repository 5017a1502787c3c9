#pragma once

#include "micro/inputs.h"
#include "shared/error.h"
#include "shared/provenance.h"

#include <filesystem>

namespace spall {

/// Loads one cell at every size of the case. Writes the damage table of all sizes, the curve, path and fields
/// of the reference size, and summary.json into `output`; prints the main results on standard output.
/// @return ExitCode::interrupted if a signal has stopped the computation; the rows computed so far are then
/// written
/// @throws ComputationError if a curve ends early; the rows computed so far are written, the table is not
ExitCode run_single_cell(const MicrocellInputs& inputs, const Provenance& provenance,
                         const std::filesystem::path& output);

} // namespace spall
