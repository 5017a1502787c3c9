#pragma once

#include "macro/contact/contact.h"
#include "macro/contact/held_points.h"
#include "macro/dynamics/central_differences.h"
#include "macro/solid/solid.h"

#include <vector>

namespace spall {

/// What a step has done to one solid.
struct SolidStep {
  MotionSums motion;
  SolidReport stresses;
  double damping = 0; ///< energy that Newmark's gamma > 1/2 has taken, J

  void list(Reduction& of_ranks);
};

/// What a step has done to one ring, J.
struct RingStep {
  double contact_loss = 0; ///< energy lost where points meet the ring
  double kinetic = 0;      ///< at the middle of the step
  double work = 0;         ///< of the hoop stress so far

  void list(Reduction& of_ranks);
};

/// What a step has done: on this rank, and after reduce() on all of them.
struct StepReport {
  std::vector<SolidStep> solids;
  std::vector<RingStep> rings;
  std::vector<Reaction> supports;
  ContactStep contact;
  SolidContactReport kernel_forces; ///< the same on all ranks

  /// Puts the parts of the ranks together: the one message of a step in which all ranks take part.
  /// @param request becomes the largest of all ranks @throws ComputationError what has failed on any rank
  void reduce(const Ranks& ranks, double& request);
};

} // namespace spall
