#pragma once

#include "shared/ranks.h"

namespace spall {

/// Condition for redistributing the points of a body over the ranks (load balance).
struct BalanceInputs {
  /// Imbalance above which points are redistributed: the largest time of a rank in the point loops over the
  /// mean of all ranks, less 1. 0: never. Moving a point costs about as much as a few of its steps, and equal
  /// loads differ by a few per cent by the clock alone.
  double tolerance = 0.1;
  int interval = 200; ///< steps between measurements of the imbalance
};

/// Load imbalance: the largest cost of a rank over the mean of all ranks, less 1; 0 if there is no cost.
/// @param costs of consecutive blocks of points, s
/// @param cuts the first block of every rank, and the number of blocks
double imbalance_of(const std::vector<double>& costs, const std::vector<std::uint64_t>& cuts);

/// Block ranges of nearly equal cost per rank: the first block of every rank, and the number of blocks. Each
/// rank begins at the block before which the running cost is nearest to its share.
std::vector<std::uint64_t> balanced_cuts(const std::vector<double>& costs, std::size_t ranks);

/// Adds the processor time that this thread takes between the timer's construction and its end to a sum, s,
/// if it is wanted.
class CostTimer {
public:
  CostTimer(double& sum_, bool wanted_) : sum(sum_), wanted(wanted_), start(wanted ? now() : 0) {}
  ~CostTimer() {
    if (wanted) sum += now() - start;
  }
  CostTimer(const CostTimer&) = delete;
  CostTimer& operator=(const CostTimer&) = delete;

private:
  static double now();
  double& sum;
  bool wanted;
  double start;
};

} // namespace spall
