#pragma once

#include "macro/dynamics/simulation.h"

#include <functional>
#include <memory>

namespace spall {

/// For output, and for what is measured on a body as a whole: one process's view of a simulation that is
/// spread over several. The first rank holds a copy of all points in their original order, which is as large
/// as a run on one rank; a simulation on one rank is its own copy.
class WholeBody {
public:
  /// @param make a simulation of the same inputs on one rank; called on the first rank, if there are several
  WholeBody(Simulation& spread_, const std::function<Simulation()>& make);

  /// Brings the copy up to date. All ranks must call it.
  void gather();
  /// On the first rank only, as of the last gather(). Neighbours are those of the present positions.
  const Simulation& view() const { return copy ? *copy : spread; }

private:
  Simulation& spread;
  std::unique_ptr<Simulation> copy;
};

} // namespace spall
