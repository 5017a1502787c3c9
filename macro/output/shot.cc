#include "macro/output/shot.h"

#include "shared/error.h"
#include "shared/input/quantity.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

namespace spall {
namespace {

/// Part of the speed that is lost, in percent; `out` is negative for a body that flies back.
double percent_lost(double in, double out) { return 100 * (in - std::abs(out)) / in; }

/// Part of the kinetic energy that is lost, in percent.
double percent_energy_lost(double in, double out) { return 100 * (1 - out * out / (in * in)); }

/// After a body has turned, its velocity does not change any more if it has changed by less than this part of
/// the impact velocity over this part of the run's time. The depth is that at the turn, whatever they are.
/// Measured on the recoil of depth_block_u.prm (turn at 0.736 ms, finally -17.68 m/s) and slab_254_axis.prm
/// (2.106 ms, -2.64 m/s): over 0.02, 0.05, 0.1 and 0.2 of the time the first ends at 0.838, 0.902, 0.952 and
/// 1.072 ms with -17.60, -17.67, -17.68 and -17.68 m/s, the second at 2.25, 2.32, 2.45 and 2.76 ms with
/// -2.60, -2.64, -2.64 and -2.60 m/s; changes of 2e-3 instead of 1e-3 end at 0.868 ms with -17.66 m/s.
constexpr double steady_part = 1e-3, quiet_part = 0.05;
/// A body that comes back with less than this part of its impact velocity is at rest: so little, 0.25 % of
/// the energy, is the recoil of a target that holds it.
constexpr double rest_part = 0.05;

} // namespace

const char* name_of(Outcome outcome) {
  switch (outcome) {
  case Outcome::perforated:
    return "perforated";
  case Outcome::stopped:
    return "stopped";
  case Outcome::rebounded:
    return "rebounded";
  case Outcome::moving:
    break;
  }
  return "moving";
}

Shot::Shot(const char* question, const std::vector<std::string>& bodies, const SceneInputs& scene,
           const FragmentInputs& fragments_, const std::string& file)
    : body(bodies[0]), target(bodies[1]), fragment_inputs(fragments_) {
  const std::string key = file + ": key 'Answers/" + std::string(question) + "': ";
  const BodyInputs *shot = scene.find(body), *struck = scene.find(target);
  if (shot == nullptr || !shot->has_shape())
    throw InputError(key + "found '" + body +
                     "', allowed: the name of a deformable or rigid body of the scene");
  if (struck == nullptr || !struck->is_deformable() || struck == shot)
    throw InputError(key + "found '" + target +
                     "', allowed: the name of another body, which must be deformable");
  if (!(shot->motion.velocity > 0))
    throw InputError(key + "'" + body + "/Velocity' is not above 0: the body does not fly at '" + target +
                     "'");
  const auto places = place_bodies(scene, file);
  front = places.at(target).lowest, back = places.at(target).highest;
  impact_speed = shot->motion.velocity;
  mass = shot->total_mass();
  flight = shot->motion;
  const Shape shape = shot->solid_shape();
  radius = extent(shape, {1, 0, 0});
  length = extent(shape, {0, 0, 1}) + extent(shape, {0, 0, -1});
  const Shape target_shape = struck->solid_shape();
  target_width = 2 * std::min(extent(target_shape, {1, 0, 0}), extent(target_shape, {0, 1, 0}));
  if (!(2 * radius < target_width))
    throw InputError(key + "'" + body + "' is " + format_quantity(2 * radius, Dimension::length) +
                     " wide, allowed: narrower than '" + target + "', " +
                     format_quantity(target_width, Dimension::length));
  touching = scene.contact.touching;
  if (struck->material.ductile()) missing = Missing::fragments;
  if (!struck->material.softens())
    unmeasured = "a target that does not soften";
  else if (struck->material.law() != Afc::name)
    unmeasured = "a target of the law " + struck->material.law();
  else if (struck->reinforcement.present())
    unmeasured = "a target with reinforcing bars";
  coasting = Coasting(back, radius);
  for (const BodyInputs& other : scene.bodies)
    if (&other != shot && &other != struck && places.contains(other.name) &&
        places.at(other.name).highest > back)
      next_body = std::min(next_body, places.at(other.name).lowest);
}

void Shot::follow(const Simulation& run) {
  latest = now(run);
  depth = std::max(depth, latest.front - front);
  if (std::isnan(break_through) && latest.front > back) break_through = run.time;
  coasting.follow(latest);
  if (!turned && latest.velocity[2] > 0) return;
  if (turned && std::abs(latest.speed() - steady_speed) <= steady_part * impact_speed) return;
  turned = true, steady_speed = latest.speed(), steady_since = run.time;
}

bool Shot::settled(const Simulation& run) const {
  return turned && run.time - steady_since >= quiet_part * run.time;
}

Outcome Shot::outcome_before_back() const {
  if (coasts()) return Outcome::perforated;
  if (!turned) return Outcome::moving;
  return std::abs(motion.speed()) <= rest_part * impact_speed ? Outcome::stopped : Outcome::rebounded;
}

double Shot::time_to_leave(const BodyMotion& motion_now, Until until) const {
  const double tail = back - motion_now.rear;
  const bool early = until == Until::settled && back + (motion_now.front - motion_now.rear) <= next_body;
  const double path = early ? std::clamp(coasting.end_of_stretch() - motion_now.front, 0.0, tail) : tail;
  return path / std::max(motion_now.velocity[2], 1e-9);
}

NumericalError Shot::numerical_error(const Numerics& numerics_of_target, double path) const {
  if (!unmeasured.empty()) return not_measured("resistance", unmeasured);
  Numerics numerics_with_contact = numerics_of_target;
  numerics_with_contact.touching = touching;
  return error_of_resistance(numerics_with_contact, path / radius, thickness() / radius);
}

Band Shot::exit_velocities(double out, Outcome outcome) const {
  if (outcome == Outcome::moving) return {};
  const double error = error_of(outcome).relative();
  return outcome == Outcome::perforated ? exit_band(impact_speed, out, error)
                                        : exit_band_of_stopped(impact_speed, depth, thickness(), error);
}

Band Shot::depths(Outcome outcome) const {
  if (outcome == Outcome::moving || outcome == Outcome::perforated) return {};
  return depth_band(depth, thickness(), error_of(outcome).relative());
}

double Shot::part_done(const Simulation& run, Until until) const {
  return run.time > 0 ? run.time / (run.time + time_to_leave(latest, until)) : 0;
}

Settlement Shot::settlement(const std::string& value, bool known) const {
  char moment[100];
  std::snprintf(moment, sizeof moment, "craters and fragments are those at %.1f us", measured_at * 1e6);
  return {.settled = known ? value : "",
          .not_settled = (known ? "" : value + ", ") + "craters, fragments",
          .remark = debris_measured
                        ? moment
                        : "not reported: the run has ended before the " + body +
                              " has left with its tail; --restart with Run/Until = answered goes on"};
}

void Shot::measure(const Simulation& run, Warnings& warnings, bool debris) {
  const Solid& solid = *run.bodies.solid(target);
  fragments.reset();
  craters.reset();
  cone.reset();
  motion = now(run);
  momentum = run.momentum_error();
  numerics = numerics_of(run, solid, radius);
  debris_measured = debris, measured_at = run.time;
  if (!debris) return;
  evaluate(
      "fragments of the " + target, [&] { fragments = find_fragments(solid, fragment_inputs, front, back); },
      warnings, run.ranks());
  if (!fragments) return;
  evaluate(
      "debris of the " + target, [&] { cone = debris_cone(solid, *fragments); }, warnings, run.ranks());
  evaluate(
      "craters of the " + target,
      [&] {
        craters = measure_craters(solid, *fragments, front, back, 0.5 * target_width, fragment_inputs.loose,
                                  missing);
      },
      warnings, run.ranks());
}

void Shot::add_craters(Summary& summary, const std::string& prefix) const {
  const double unknown = std::nan("");
  const auto add = [&](const std::string& face, const Crater* crater, double scatter) {
    const auto set = [&](const char* key, double value) {
      summary.set(prefix + face + "_crater_" + key, crater ? value : unknown);
    };
    const double diameter = crater ? crater->mean_diameter : unknown;
    // What was measured is the scatter of concrete, two standard deviations.
    const double open = missing == Missing::fragments ? unknown : 2 * scatter * diameter;
    set("diameter", diameter);
    set("diameter_low", diameter - open);
    set("diameter_high", diameter + open);
    set("largest_diameter", crater ? crater->largest_diameter : unknown);
    set("depth", crater ? crater->deepest : unknown);
  };
  add("front", craters ? &craters->front : nullptr, front_scatter);
  add("back", craters ? &craters->back : nullptr, back_scatter);
}

void Shot::add_to(Summary& summary, const Simulation& run, const std::string& prefix, double out,
                  Outcome outcome) const {
  const double in = impact_speed;
  const auto set = [&](const char* key, const auto& value) { summary.set(prefix + key, value); };
  set("projectile", body);
  set("target", target);
  set("outcome", name_of(outcome));
  set("impact_velocity", in);
  set("thickness", thickness());
  set("struck_face", front);
  set("diameter", target_width);
  set("final_velocity", motion.speed()); // behind a witness plate, if there is one
  set("delta_v_percent", percent_lost(in, out));
  set("delta_ke_percent", percent_energy_lost(in, out));
  set("absorbed_energy", 0.5 * mass * (in * in - out * out));
  set("perforated", outcome == Outcome::perforated);
  set("penetration_depth", outcome == Outcome::perforated ? std::nan("") : depth);
  depths(outcome).add_to(summary, prefix + "penetration_depth");
  set("rebound_velocity", outcome == Outcome::rebounded ? -out : std::nan(""));
  add_craters(summary, prefix);
  set("projectile_mass", mass);
  error_of(outcome).add_to(summary, prefix);
  if (!flight.is_normal()) {
    set("obliquity", flight.obliquity);
    set("angle_of_attack", flight.attack);
    set("final_direction", std::atan2(motion.velocity[0], motion.velocity[2]));
    set("final_axis", std::atan2(motion.axis[0], motion.axis[2]));
    set("final_angular_velocity", motion.turning[1]);
  }
  set("linear_momentum_error", momentum.linear);
  set("angular_momentum_error", momentum.angular);
  set("projectile_radius", radius);
  set("projectile_length", length);
  Summary of_fragments;
  add_fragments(of_fragments, fragments.value_or(Fragments{}), run.bodies.solid(target)->ghosts.symmetry(),
                prefix);
  if (!fragments) of_fragments.forget_values();
  summary.add(of_fragments);
  const DebrisCone debris = cone.value_or(DebrisCone{});
  set("debris_half_angle_50", debris.half_of_energy);
  set("debris_half_angle_90", debris.most_of_energy);
}

void Shot::write_tables(const std::filesystem::path& directory, const std::string& prefix) const {
  if (fragments) write_fragments(directory / (prefix + "fragments.csv"), *fragments);
  if (craters) write_craters(directory, prefix, *craters);
  if (cone) write_debris_cone(directory / (prefix + "debris_cone.csv"), *cone);
}

std::string Shot::in_words(double out, Outcome outcome) const {
  static const std::map<Outcome, const char*> states = {{Outcome::perforated, "passes"},
                                                        {Outcome::stopped, "is at rest in"},
                                                        {Outcome::rebounded, "has rebounded from"},
                                                        {Outcome::moving, "is still moving in or before"}};
  const Band exits = exit_velocities(out, outcome);
  const bool passes = outcome == Outcome::perforated;
  char text[400];
  std::snprintf(text, sizeof text, "the %s %s the %s: velocity %.1f m/s%s after %.1f m/s at impact",
                body.c_str(), passes && motion.rear > back ? "has passed" : states.at(outcome),
                target.c_str(), out, passes ? exits.in_words(1).c_str() : "", impact_speed);
  std::string words = text;
  std::snprintf(text, sizeof text, ", speed lost %.1f %%, kinetic energy lost %.1f %%",
                percent_lost(impact_speed, out), percent_energy_lost(impact_speed, out));
  words += text;
  if (!passes) {
    std::snprintf(text, sizeof text, ", largest depth %.1f mm%s", depth * 1e3,
                  depths(outcome).in_words(1, 1e3).c_str());
    words += text;
  }
  if (passes && exits.low == 0) words += "; within the numerical error it may be stopped";
  if (!passes && exits.high > 0) {
    std::snprintf(text, sizeof text, "; within the numerical error it may perforate with up to %.1f m/s",
                  exits.high);
    words += text;
  }
  return words + debris_in_words() + "\nnumerical error: " + error_of(outcome).in_words(body);
}

std::string Shot::debris_in_words() const {
  if (!fragments) return "";
  const FragmentSums debris = sum_of(*fragments, FragmentPlace::debris),
                     ejecta = sum_of(*fragments, FragmentPlace::ejecta);
  char text[400];
  std::snprintf(text, sizeof text, "; %.0f fragments (%.2f kg) behind the %s, %.0f (%.2f kg) before it",
                debris.count, debris.mass, target.c_str(), ejecta.count, ejecta.mass);
  return text;
}

void Shot::transfer(Archive& archive) {
  for (double* part : {&depth, &break_through, &steady_speed, &steady_since}) archive("shot", *part);
  archive("shot_latest", latest);
  archive("shot_turned", turned);
  coasting.transfer(archive);
}

} // namespace spall
