#pragma once

#include "macro/dynamics/body_motion.h"
#include "macro/dynamics/simulation.h"
#include "macro/output/coasting.h"
#include "macro/output/craters.h"
#include "macro/output/debris_cone.h"
#include "macro/output/evaluation.h"
#include "macro/output/numerical_error.h"
#include "macro/output/settlement.h"
#include "macro/output/until.h"
#include "macro/scene/placement.h"
#include "shared/summary.h"

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace spall {

/// The present outcome of a shot.
enum class Outcome {
  perforated, ///< the body's tail is behind the target, or the body coasts out of it
  stopped,    ///< the body is at rest in the target
  rebounded,  ///< the body flies back
  moving      ///< the body is still moving towards or through the target
};
const char* name_of(Outcome outcome);

/// A body that flies at a target along +z: the common part of the answers about exit and penetration.
struct Shot {
  /// @param question name of the answer's key, for messages. @throws InputError
  Shot(const char* question, const std::vector<std::string>& bodies, const SceneInputs& scene,
       const FragmentInputs& fragments, const std::string& file);

  std::string body, target;
  double front = 0, back = 0;    ///< z of the target's faces at the start, m
  double impact_speed = 0;       ///< velocity at impact, m/s
  double mass = 0;               ///< mass of the whole body, kg
  double radius = 0, length = 0; ///< radius and length of the body, m
  double target_width = 0;       ///< diameter or smallest width of the target, m
  std::string unmeasured;        ///< of what the numerical error of the resistance is not known; empty: it is
  MotionInputs flight;
  FragmentInputs fragment_inputs;

  double thickness() const { return back - front; } ///< of the target, m

  /// Must be called after every step until the tail has left: keeps the depth, and watches whether the
  /// velocity still changes.
  void follow(const Simulation& run);
  BodyMotion latest; ///< motion of the body after the last step, known on all ranks
  double depth = 0;  ///< largest depth of the foremost point below the struck face so far, m
  /// Time at which the foremost point passed the back of the target for the first time, s.
  double break_through = std::numeric_limits<double>::quiet_NaN();

  // Results of measure().
  BodyMotion motion; ///< motion of the body
  MomentumError momentum;
  Numerics numerics;                              ///< of the target
  std::optional<Fragments> fragments;             ///< of the target; none if they could not be found
  TouchingPart touching = TouchingPart::cell;     ///< of the target
  Missing missing = Missing::fragments_and_moved; ///< at the faces of the target
  std::optional<Craters> craters;
  std::optional<DebrisCone> cone;

  BodyMotion now(const Simulation& run) const { return motion_of(run.bodies, body); }
  /// Returns whether the body has turned round and its velocity does not change any more: what is left is
  /// rest, or the flight of a rebound.
  bool settled(const Simulation& run) const;
  /// Returns whether the body leaves the target without losing velocity any more, although its tail is still
  /// inside. Never if it can meet another body before its tail has left.
  bool coasts() const { return coasting.coasts() && path_is_free(); }
  /// Returns the outcome of a body whose tail has not left the back of the target, as measured.
  Outcome outcome_before_back() const;
  /// Returns the velocity of an outcome along the flight, m/s: 0 of a body at rest, negative of a rebound.
  double velocity_of(Outcome outcome) const { return outcome == Outcome::stopped ? 0 : motion.speed(); }
  /// Returns the time at the present velocity until the exit can be answered, s.
  double time_to_leave(const Simulation& run, Until until) const { return time_to_leave(now(run), until); }
  /// Returns the numerical error of the target's resistance along a path, m. A path of 0 gives that of short
  /// paths.
  NumericalError numerical_error(const Numerics& numerics_of_target, double path) const;
  NumericalError numerical_error(const Simulation& run, double path) const {
    return numerical_error(numerics_of(run, *run.bodies.solid(target), radius), path);
  }
  /// Returns the progress of the body through the target. Needs no other rank.
  double part_done(const Simulation& run, Until until) const;

  /// What cannot be measured is left out, with a warning. @param debris whether craters and fragments are
  /// measured: those of a body that is still on its way out would be taken for the final ones.
  void measure(const Simulation& run, Warnings& warnings, bool debris);
  /// Returns what of the values does not change any more. @param value name of the one that is asked for, and
  /// whether it is known
  Settlement settlement(const std::string& value, bool known) const;
  /// What is known of the bodies and how the body has moved, given its velocity when it left the target, came
  /// to rest or rebounded.
  /// @param prefix of the names
  void add_to(Summary& summary, const Simulation& run, const std::string& prefix, double out,
              Outcome outcome) const;
  void write_tables(const std::filesystem::path& directory, const std::string& prefix) const;
  /// Returns the exit velocities that the numerical error leaves open, m/s. @param out the same velocity
  Band exit_velocities(double out, Outcome outcome) const;
  /// @param out the same velocity
  std::string in_words(double out, Outcome outcome) const;
  void transfer(Archive& archive);

private:
  /// Returns whether no other body is as near behind the target as the body is long.
  bool path_is_free() const { return back + (latest.front - latest.rear) <= next_body; }
  double time_to_leave(const BodyMotion& motion, Until until) const;
  void add_craters(Summary& summary, const std::string& prefix) const;
  NumericalError error_of(Outcome outcome) const {
    return numerical_error(numerics, outcome == Outcome::perforated ? thickness() : depth);
  }
  Band depths(Outcome outcome) const; ///< that the numerical error leaves open, m
  std::string debris_in_words() const;

  double next_body = std::numeric_limits<double>::infinity(); ///< z of the nearest body behind, m
  Coasting coasting;
  bool debris_measured = false;              ///< whether craters and fragments have been asked for
  double measured_at = 0;                    ///< time of measure(), s
  bool turned = false;                       ///< whether the body has stopped advancing
  double steady_speed = 0, steady_since = 0; ///< velocity that is not left any more, m/s; since when, s
};

} // namespace spall
