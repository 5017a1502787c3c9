#pragma once

#include "shared/ranks.h"

namespace spall {

/// When the points of a body are shared out anew over the ranks, by what they have cost.
struct BalanceInputs {
  /// Largest excess of a rank's time in the point loops over the mean of all ranks, relative to that; 0:
  /// points stay where they are. Moving a point costs about as much as a few of its steps, and equal shares
  /// differ by a few per cent by the clock alone.
  double tolerance = 0.1;
  int interval = 200; ///< steps between looks
};

/// Costs of consecutive pieces of all ranks under cuts: the excess of the most expensive rank over the mean,
/// relative to that. @param cuts first piece of every rank, and the number of all
double imbalance_of(const std::vector<double>& costs, const std::vector<std::uint64_t>& cuts);

/// Cuts with which every rank has about the same cost: each is where the sum up to it comes nearest to its
/// part of the whole.
std::vector<std::uint64_t> balanced_cuts(const std::vector<double>& costs, std::size_t ranks);

/// Adds the processor time of this thread between its construction and its end to a sum, s, if it is wanted.
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
