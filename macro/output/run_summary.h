#pragma once

#include "macro/output/answers.h"
#include "shared/provenance.h"
#include "shared/summary.h"

#include <filesystem>
#include <string>
#include <vector>

namespace spall {

/// Data of a run that only the main loop has.
struct RunRecord {
  Provenance provenance;
  std::vector<std::filesystem::path> files{}; ///< that its keys name
  std::string scheme;                         ///< of the integration
  std::string ended{};  ///< "finished", "end time", "interrupted", "failed: ..." or "not evaluated"
  double wall = 0;      ///< time of the steps and the output between them, s
  double processor = 0; ///< processor time of that on all threads, s
  double setup = 0;     ///< input, points, first fields: wall time, s
  double output = 0;    ///< wall time between the steps, s
  int ranks = 1;        ///< processes
  double imbalance = 0; ///< load imbalance of the ranks in the point loops, at the last check
  std::size_t rebalances = 0;
  double model_bytes = 0; ///< of all ranks
  int restarts = 0;       ///< times the run went on from a checkpoint
  Warnings warnings{};    ///< what could not be evaluated or written at its end
};

/// summary.json: what was computed, how, at what cost, how sound it is, and the scene's answers, if they have
/// been measured (`answered`). All ranks must call it.
Summary summarize(const Simulation& run, const SceneInputs& scene, const RunRecord& record,
                  const Answers& answers, bool answered);

/// Prints answers and cost at the end of a run on standard output.
void print_result(const Simulation& run, const RunRecord& record, const Answers& answers);

} // namespace spall
