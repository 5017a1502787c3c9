#include "macro/output/penetration_answer.h"

namespace spall {

Outcome PenetrationAnswer::outcome() const {
  return shot.motion.rear > shot.back ? Outcome::perforated : shot.outcome_before_back();
}

void PenetrationAnswer::add_to(Summary& summary, const Simulation& run, const std::string& prefix) const {
  shot.add_to(summary, run, prefix, shot.velocity_of(outcome()), outcome());
}

std::string PenetrationAnswer::in_words() const {
  return shot.in_words(shot.velocity_of(outcome()), outcome());
}

} // namespace spall
