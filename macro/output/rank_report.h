#pragma once

#include "macro/dynamics/simulation.h"
#include "shared/summary.h"

namespace spall {

/// Memory, work and traffic of the ranks since the run began or was restarted: the largest value of any rank,
/// and the mean. All ranks must call it; with one rank nothing is sent.
class RankReport {
public:
  explicit RankReport(const Simulation& run);

  /// Keys NAME_max and NAME_mean: owned_points, ghost_points (copies of other ranks' points), compute_seconds
  /// (processor time of the steps outside MPI), messages_per_step and bytes_per_step (sent to other ranks in
  /// every step); imbalance (largest over mean compute_seconds). Keys WHAT_per_step_USE, of the rank with
  /// most: messages, bytes, collectives, collective_bytes and gathered_bytes by the uses of MpiUse, spread
  /// over all steps.
  void add_to(Summary& summary) const;

private:
  struct Number {
    std::string name;
    double largest, sum;
    bool with_mean;
  };
  void add(const std::string& name, double value, bool with_mean);

  std::vector<Number> numbers;
  double ranks = 1;
};

} // namespace spall
