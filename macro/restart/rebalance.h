#pragma once

#include "macro/dynamics/simulation.h"
#include "macro/points/balance.h"

namespace spall {

/// Gives every rank other points of each solid, with all that they remember, between steps: the state is
/// transferred as into a checkpoint and back, in memory, whole blocks to where they belong then. All ranks
/// must call it. @param cuts by solid: first block of each rank, and the number of all
void move_points(Simulation& run, const std::vector<std::vector<std::uint64_t>>& cuts);

/// Looks from time to time at what the points of each rank have cost, and shares them out anew.
class Balancer {
public:
  explicit Balancer(const BalanceInputs& inputs_) : inputs(inputs_) {}

  /// After every step; all ranks must call it. With one rank nothing is done.
  void look(Simulation& run);

  double imbalance() const { return last; }            ///< load imbalance at the last check (imbalance_of)
  std::size_t rebalances() const { return movements; } ///< times that points have moved

private:
  BalanceInputs inputs;
  double last = 0;
  std::size_t movements = 0;
};

} // namespace spall
