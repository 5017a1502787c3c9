#pragma once

#include "macro/output/answers.h"
#include "shared/provenance.h"
#include "shared/summary.h"

#include <string>

namespace spall {

/// Data of a run that only the main loop has.
struct RunRecord {
  Provenance provenance;
  std::string scheme;   ///< name of the integration scheme
  std::string ended{};  ///< "finished", "end time", "interrupted" or "failed: ..."
  double wall = 0;      ///< time of the steps and the output between them, s
  double processor = 0; ///< processor time of that on all threads, s
  double setup = 0;     ///< input, points, first fields: wall time, s
  double output = 0;    ///< wall time between the steps, s
  int ranks = 1;        ///< processes
  double imbalance = 0; ///< load imbalance of the ranks in the point loops, at the last check
  std::size_t rebalances = 0;
  double model_bytes = 0; ///< memory of the model on all ranks, bytes
  int restarts = 0;       ///< number of times that the run was continued from a checkpoint
};

/// Makes summary.json: scene and numerics, cost, balances and detectors of instabilities, and the scene's
/// answers. All ranks must call it.
Summary summarize(const Simulation& run, const SceneInputs& scene, const RunRecord& record,
                  const Answers& answers);

/// Prints answers and cost at the end of a run on standard output.
void print_result(const Simulation& run, const RunRecord& record, const Answers& answers);

} // namespace spall
