#include "macro/output/exit_answer.h"

#include <cmath>

namespace spall {

void ExitAnswer::follow(const Simulation& run) {
  if (left()) return;
  shot.follow(run);
  const BodyMotion& now = shot.latest;
  if (now.rear > shot.back && now.speed() > 0) time = run.time, speed = now.speed(), at_exit = now;
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
  if (shot.flight.is_normal()) return;
  // Of a body that coasts the end of the run shows the attitude in which it leaves.
  const BodyMotion& leaving = left() ? at_exit : shot.motion;
  const auto set = [&](const char* key, double value) {
    summary.set(prefix + key, outcome() == Outcome::perforated ? value : std::nan(""));
  };
  set("exit_direction", std::atan2(leaving.velocity[0], leaving.velocity[2]));
  set("exit_axis", std::atan2(leaving.axis[0], leaving.axis[2]));
  set("exit_angular_velocity", leaving.turning[1]);
}

std::string ExitAnswer::in_words() const { return shot.in_words(velocity(), outcome()); }

void ExitAnswer::transfer(Archive& archive) {
  shot.transfer(archive);
  archive("exit_time", time);
  archive("exit_speed", speed);
  archive("exit_motion", at_exit);
}

} // namespace spall
