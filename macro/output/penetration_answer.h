#pragma once

#include "macro/output/shot.h"

namespace spall {

/// The penetration depth of a body in a target: `BODY into TARGET`.
class PenetrationAnswer {
public:
  static constexpr const char* name = "Penetration";
  static constexpr const char* help =
      "penetration of bodies into targets, as 'BODY into TARGET', separated by commas: largest depth of the "
      "foremost point, craters and fragments of the target";
  static constexpr const char* separator = " into ";

  PenetrationAnswer(const std::vector<std::string>& bodies, const SceneInputs& scene,
                    const FragmentInputs& fragments, const std::string& file)
      : shot(name, bodies, scene, fragments, file) {}

  void follow(const Simulation& run) { shot.follow(run); }
  bool complete(const Simulation& run) const { return shot.settled(run) || passed(run); }
  bool settled(const Simulation& run) const { return complete(run) || shot.coasts(); }
  double part_done(const Simulation& run, Until) const {
    return run.steps == 0 ? 0 : 1 - std::max(0.0, shot.latest.velocity[2]) / shot.impact_speed;
  }
  /// A lower bound without deceleration, which is not known before the run.
  double shortest_time(const Simulation& run, Until until) const { return shot.time_to_leave(run, until); }
  std::optional<NumericalError> numerical_error(const Simulation& run) const {
    return shot.numerical_error(run, 0); // the depth is not known before the run
  }
  void measure(const Simulation& run, Warnings& warnings, bool debris) {
    shot.measure(run, warnings, debris);
  }
  Settlement settlement(const Simulation& run) const {
    return shot.settlement("penetration depth", settled(run));
  }
  void add_to(Summary& summary, const Simulation& run, const std::string& prefix) const;
  void write_tables(const std::filesystem::path& directory, const std::string& prefix) const {
    shot.write_tables(directory, prefix);
  }
  std::string in_words() const;
  void transfer(Archive& archive) { shot.transfer(archive); }

  const std::string& moving() const { return shot.body; }
  const std::string& main() const { return shot.target; }
  bool has_fragments() const { return true; }
  const Shot& shot_of() const { return shot; }
  Outcome outcome() const;

private:
  bool passed(const Simulation& run) const { return run.steps > 0 && shot.latest.rear > shot.back; }
  Shot shot;
};

} // namespace spall
