#include "macro/output/penetration_answer.h"

#include <algorithm>
#include <cstdio>

namespace spall {

void PenetrationAnswer::follow(const Simulation& run) {
  depth = std::max(depth, shot.now(run).front - shot.front);
}

Outcome PenetrationAnswer::outcome() const {
  if (shot.motion.rear > shot.back) return Outcome::perforated;
  return shot.motion.velocity[2] <= 0 ? Outcome::stopped : Outcome::moving;
}

void PenetrationAnswer::add_to(Summary& summary, const Simulation& run, const std::string& prefix) const {
  shot.add_to(summary, run, prefix, shot.motion.speed(), outcome());
  summary.set(prefix + "penetration_depth", depth);
}

std::string PenetrationAnswer::in_words() const {
  char text[200];
  std::snprintf(text, sizeof text, "the %s has come %.1f mm into the %s (%s): ", shot.body.c_str(),
                depth * 1e3, shot.target.c_str(), name_of(outcome()));
  return text + shot.in_words(shot.motion.speed());
}

} // namespace spall
