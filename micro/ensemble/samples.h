#pragma once

#include "micro/inputs.h"
#include "shared/damage_table.h"
#include "shared/ranks.h"

#include <filesystem>

namespace spall {

/// Result of computing an ensemble's samples: sums over all ranks.
struct SampleReport {
  int computed = 0, reused = 0;
  std::vector<std::string> failures; ///< one message for each failed sample, which names its seed
  bool interrupted = false;
};

/// Computes the samples of an ensemble. Samples are dealt to the ranks in turn and computed by their threads.
/// Each is written to a file `sample_NNNNNN.h5` in `folder`: the damage table of a single cell with
/// Cracks/Seed set to the sample's seed, so that any sample can be repeated alone. Samples are independent of
/// each other, so their results do not depend on ranks, threads or interruptions. All ranks get the same
/// report, once all samples are done.
/// @param threads number of threads of each rank
/// @param provenance program and input that are recorded in every file
/// @param folder folder of the sample files; it must be the same on all ranks
/// @param reuse keeps existing files whose whole recorded input agrees; otherwise all samples are computed
/// anew
SampleReport compute_samples(const MicrocellInputs& inputs, const Ranks& ranks, int threads,
                             const Provenance& provenance, const std::filesystem::path& folder, bool reuse);

/// Whether a folder has a sample of this ensemble, which a run can go on from.
bool has_samples(const MicrocellInputs& inputs, const Provenance& provenance,
                 const std::filesystem::path& folder);

/// Whether a folder holds a run of just this input, by its resolved.prm.
bool holds_input(const Provenance& provenance, const std::filesystem::path& output);
/// Whether a folder has the complete results of just this input.
bool is_finished(const MicrocellInputs& inputs, const Provenance& provenance,
                 const std::filesystem::path& output);

/// Where sample i lives.
std::filesystem::path sample_file(const std::filesystem::path& folder, int sample);

/// Returns a damage table without curves: material constants, descriptions and provenance.
DamageTable describe_table(const MicrocellInputs& inputs, const Provenance& provenance);

} // namespace spall
