#pragma once

#include "micro/inputs.h"
#include "shared/error.h"
#include "shared/provenance.h"
#include "shared/ranks.h"

#include <filesystem>

namespace spall {

/// Computes many random cells, distributed over ranks and threads. Writes the samples, the tables of the mean
/// and of the band, curve.csv and summary.json into `output`. All ranks must call it; the first rank writes
/// every file except the samples. The tables depend neither on the number of ranks nor on that of threads.
/// @throws ComputationError if more than a tenth of the samples fail
ExitCode run_ensemble(const MicrocellInputs& inputs, const Ranks& ranks, const Provenance& provenance,
                      const std::filesystem::path& output, bool restart);

} // namespace spall
