#pragma once

#include "macro/output/shot.h"

namespace spall {

/// The exit of a body from a target that it perforates: `BODY through TARGET`.
class ExitAnswer {
public:
  static constexpr const char* name = "Exit";
  static constexpr const char* help =
      "exits of bodies from targets, as 'BODY through TARGET', separated by commas: exit velocity, energy "
      "lost, craters and fragments of the target";
  static constexpr const char* separator = " through ";

  ExitAnswer(const std::vector<std::string>& bodies, const SceneInputs& scene,
             const FragmentInputs& fragments, const std::string& file)
      : shot(name, bodies, scene, fragments, file) {}

  void follow(const Simulation& run);
  bool complete(const Simulation& run) const { return left() || shot.settled(run); }
  bool settled(const Simulation& run) const { return complete(run) || shot.coasts(); }
  double part_done(const Simulation& run, Until until) const;
  double shortest_time(const Simulation& run, Until until) const { return shot.time_to_leave(run, until); }
  std::optional<NumericalError> numerical_error(const Simulation& run) const {
    return shot.numerical_error(run, shot.thickness());
  }
  void measure(const Simulation& run, Warnings& warnings, bool debris) {
    shot.measure(run, warnings, debris);
  }
  Settlement settlement(const Simulation& run) const {
    return shot.settlement(left() || shot.coasts() ? "exit velocity" : "exit velocity, penetration depth",
                           settled(run));
  }
  void add_to(Summary& summary, const Simulation& run, const std::string& prefix) const;
  void write_tables(const std::filesystem::path& directory, const std::string& prefix) const {
    shot.write_tables(directory, prefix);
  }
  std::string in_words() const;
  void transfer(Archive& archive);

  const std::string& moving() const { return shot.body; }
  const std::string& main() const { return shot.target; }
  bool has_fragments() const { return true; }
  const Shot& shot_of() const { return shot; }
  Outcome outcome() const { return left() ? Outcome::perforated : shot.outcome_before_back(); }

private:
  bool left() const { return !std::isnan(time); }

  double velocity() const { return left() ? speed : shot.velocity_of(outcome()); } ///< m/s

  Shot shot;
  /// Time and velocity of the exit, s and m/s.
  double time = std::numeric_limits<double>::quiet_NaN(), speed = time;
  BodyMotion at_exit; ///< motion at that time
};

} // namespace spall
