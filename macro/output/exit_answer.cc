#include "macro/output/exit_answer.h"

#include <cmath>

namespace spall {

void ExitAnswer::follow(const Simulation& run) {
  if (left()) return;
  shot.follow(run);
  const BodyMotion& now = shot.latest;
  if (now.rear > shot.back && now.speed() > 0) time = run.time, speed = now.speed();
}

double ExitAnswer::part_done(const Simulation& run, Until until) const {
  return left() ? 1 : shot.part_done(run, until);
}

void ExitAnswer::add_to(Summary& summary, const Simulation& run, const std::string& prefix) const {
  shot.add_to(summary, run, prefix, velocity(), outcome());
  // The exit velocity is unknown while the body is still in the target, and zero if it will not come out.
  const bool inside = outcome() == Outcome::moving;
  summary.set(prefix + "exit_velocity", inside                             ? std::nan("")
                                        : outcome() == Outcome::perforated ? velocity()
                                                                           : 0.0);
  shot.exit_velocities(velocity(), outcome()).add_to(summary, prefix + "exit_velocity");
  summary.set(prefix + "time_of_exit", time);
}

std::string ExitAnswer::in_words() const { return shot.in_words(velocity(), outcome()); }

void ExitAnswer::transfer(Archive& archive) {
  shot.transfer(archive);
  archive("exit_time", time);
  archive("exit_speed", speed);
}

} // namespace spall
