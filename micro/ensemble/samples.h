#pragma once

#include "micro/inputs.h"
#include "shared/damage_table.h"
#include "shared/ranks.h"

#include <filesystem>

namespace spall {

/// What became of an ensemble's samples, on all ranks.
struct SampleReport {
  int computed = 0, reused = 0;
  std::vector<std::string> failures; ///< one line each, naming the seed
  bool interrupted = false;
};

/// Computes the samples of an ensemble over ranks (in turn) and their threads, one file `sample_NNNNNN.h5`
/// each in `folder`: a damage table like that of a single cell with Cracks/Seed set to the sample's, so that
/// any of them can be repeated alone. Samples do not know of each other, so ranks, threads and interruptions
/// change nothing in them. All ranks get the same report, once all samples are done.
/// @param threads of each rank
/// @param provenance written in every file
/// @param folder must be the same on all ranks
/// @param reuse keep files whose whole recorded input agrees; else they are computed anew
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

/// Table without curves: constants, words and provenance.
DamageTable describe_table(const MicrocellInputs& inputs, const Provenance& provenance);

} // namespace spall
