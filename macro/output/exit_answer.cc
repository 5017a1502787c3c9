#include "macro/output/exit_answer.h"

#include <cmath>

namespace spall {

void ExitAnswer::follow(const Simulation& run) {
  if (left()) return;
  const BodyMotion now = shot.now(run);
  if (now.rear > shot.back && now.speed() > 0) time = run.time, speed = now.speed();
}

double ExitAnswer::part_done(const Simulation& run) const { return left() ? 1 : shot.part_done(run); }

void ExitAnswer::add_to(Summary& summary, const Simulation& run, const std::string& prefix) const {
  const double out = left() ? speed : shot.motion.speed();
  const Outcome outcome = left() ? Outcome::perforated : out <= 0 ? Outcome::stopped : Outcome::moving;
  shot.add_to(summary, run, prefix, out, outcome);
  // The exit velocity is unknown while the body is still in the target.
  summary.set(prefix + "exit_velocity", left() ? out : out <= 0 ? 0.0 : std::nan(""));
  summary.set(prefix + "time_of_exit", time);
}

std::string ExitAnswer::in_words() const {
  const double out = left() ? speed : shot.motion.speed();
  const std::string state = left() ? "has passed" : out <= 0 ? "is stopped by" : "is still in or before";
  return "the " + shot.body + " " + state + " the " + shot.target + ": " + shot.in_words(out);
}

void ExitAnswer::transfer(Archive& archive) {
  archive("exit_time", time);
  archive("exit_speed", speed);
}

} // namespace spall
