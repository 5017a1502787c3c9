#pragma once

#include "micro/inputs.h"
#include "shared/error.h"
#include "shared/provenance.h"
#include "shared/ranks.h"

#include <filesystem>

namespace spall {

/// Many random cells over ranks and threads: writes their samples, the tables of the mean and of the band,
/// curve.csv and summary.json into `output`. All ranks must call it; the first one writes what is not a
/// sample. The tables depend neither on ranks nor on threads.
/// @param restart keeps the samples of this case that are there
/// @throws ComputationError if more than a tenth of the samples fail
ExitCode run_ensemble(const MicrocellInputs& inputs, const Ranks& ranks, const Provenance& provenance,
                      const std::filesystem::path& output, bool restart);

} // namespace spall
