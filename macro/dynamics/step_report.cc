#include "macro/dynamics/step_report.h"

#include "shared/error.h"
#include "shared/traffic.h"

namespace spall {

void SolidStep::list(Reduction& of_ranks) {
  stresses.list(of_ranks);
  for (double* sum : {&damping, &motion.kinetic, &motion.momentum}) of_ranks.sums.push_back(sum);
}

void RingStep::list(Reduction& of_ranks) {
  for (double* sum : {&contact_loss, &kinetic, &work}) of_ranks.sums.push_back(sum);
}

void StepReport::reduce(const Ranks& ranks, double& request) {
  const TrafficOf use(MpiUse::reductions);
  std::vector<std::string> failures;
  for (const SolidStep& solid : solids)
    if (!solid.stresses.failure.empty()) failures.push_back(solid.stresses.failure);
  double failed = !failures.empty();
  Reduction all{.largest = {&failed, &request}};
  for (SolidStep& solid : solids) solid.list(all);
  for (RingStep& ring : rings) ring.list(all);
  for (Reaction& support : supports) support.list(all);
  contact.list(all);
  ranks.reduce(all);
  if (failed > 0) throw ComputationError(ranks.gather(failures).front());
}

} // namespace spall
