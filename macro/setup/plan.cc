#include "macro/setup/plan.h"

#include "macro/setup/check_bodies.h"
#include "macro/setup/check_shots.h"
#include "macro/setup/make_simulation.h"
#include "shared/error.h"
#include "shared/progress.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace spall {
namespace {

/// Processor time for which steps are timed, s, and smallest number of refreshes that are timed.
constexpr double calibration_time = 1;
constexpr std::size_t calibration_refreshes = 3, most_calibration_steps = 2000;

/// Ranges of support size and step factor that have been measured (data/studies). Smaller supports lose their
/// neighbours, larger ones only cost time. Larger steps are shortened by the stability estimates, or fail
/// where concrete breaks.
constexpr double smallest_support = 1.8, largest_support = 2.25, largest_step_concrete = 0.6,
                 largest_step_metal = 0.7;

template<class... Values> std::string line(const char* format, Values... values) {
  char text[400];
  std::snprintf(text, sizeof text, format, values...);
  return std::string(text) + "\n";
}

std::string list(double a, double b, const char* format) {
  const std::string one = line(format, a), other = line(format, b);
  const auto bare = [](const std::string& s) { return s.substr(0, s.size() - 1); };
  return one == other ? bare(one) : bare(one) + " to " + bare(other);
}

/// Returns the number of points of the whole body, from the modelled part.
double whole_points(const Points& points, const SymmetryPlanes& planes) {
  if (!planes.axis) return static_cast<double>(points.owned) * planes.multiplicity();
  double sum = 0;
  for (std::size_t i = 0; i < points.owned; ++i)
    sum += points_on_ring(points.position.component[0][i], points.spacing[i]);
  return sum;
}

std::string body_lines(const Simulation& run) {
  std::string text;
  for (const auto& solid : run.bodies.solids) {
    const Points& p = solid->points;
    const auto [fine, coarse] = std::minmax_element(p.spacing.begin(), p.spacing.end());
    text +=
        line("%s: %zu points modelled, %.0f in the whole body, spacing %s mm", solid->label.c_str(), p.owned,
             whole_points(p, solid->ghosts.symmetry()), list(*fine * 1e3, *coarse * 1e3, "%.2f").c_str());
  }
  return text;
}

std::string cost_lines(const Answers& answers, const RunInputs& inputs, Simulation& run) {
  const double asked = answers.shortest_time(run);
  const double shortest = asked > 0 ? std::min(asked, inputs.time.end_time) : inputs.time.end_time;
  run.advance(); // the first step finds the neighbours and the largest stable step
  const std::size_t first = run.steps, refreshed = run.health.refreshes;
  const Stopwatch watch;
  while (
      (watch.cpu_seconds() < calibration_time || run.health.refreshes < refreshed + calibration_refreshes) &&
      run.steps < most_calibration_steps && run.time < inputs.time.end_time)
    run.advance();
  const double timed = static_cast<double>(std::max<std::size_t>(run.steps - first, 1));
  const double per_step = watch.cpu_seconds() / timed;
  std::size_t bytes = 0;
  for (const auto& solid : run.bodies.solids) bytes += solid->memory_bytes();
  const double points = static_cast<double>(run.point_count());
  const double few = shortest / run.step, many = inputs.time.end_time / run.step;
  std::string text = line("memory: %.1f MB, %.0f bytes per point", 1e-6 * static_cast<double>(bytes),
                          static_cast<double>(bytes) / points);
  text += line("step: %.3f us, %.3g of the largest stable one", run.step * 1e6,
               1 / run.health.smallest_step_margin);
  text += line("steps: %.0f (a projectile without deceleration, a bar's elastic wave forth and back) to %.0f "
               "(Time/End time)",
               few, many);
  text += line("cost: %.0f ns of processor time per point and step, over %.0f steps from the start",
               1e9 * per_step / points, timed);
  text += line("processor time: %s to %s; more where much material breaks, because neighbours are searched "
               "again there",
               format_duration(few * per_step).c_str(), format_duration(many * per_step).c_str());
  return text;
}

/// The main bodies of the scene: the target or bar, and the projectile if there is one.
struct Subject {
  const BodyInputs& main;
  const BodyInputs* projectile; ///< null if the main body is the one that moves
};

/// Whether all bodies of the scene have these symmetry planes: their motions, places and shapes.
bool has_planes(const SceneInputs& scene, const std::vector<std::string>& symmetry) {
  SceneInputs variant = scene;
  variant.symmetry = symmetry;
  try {
    variant.validate("scene");
    return true;
  } catch (const InputError&) {
    return false;
  }
}

/// Returns the number of points of the main body with other symmetry planes.
std::size_t points_with(const SceneInputs& scene, const std::string& body,
                        const std::vector<std::string>& symmetry) {
  SceneInputs variant = scene;
  variant.symmetry = symmetry;
  return make_points(variant, body).owned;
}

std::string symmetry_lines(const SceneInputs& scene, const Subject& subject) {
  const SymmetryPlanes planes = scene.planes();
  const auto variant = [&](const char* why, const char* keys, const std::vector<std::string>& symmetry) {
    if (!has_planes(scene, symmetry)) return std::string();
    return line("symmetry: %s; Scene/Symmetry planes = %s has %zu points", why, keys,
                points_with(scene, subject.main.name, symmetry));
  };
  const auto oblique = [](const BodyInputs& body) { return body.has_shape() && !body.motion.is_normal(); };
  if (std::any_of(scene.bodies.begin(), scene.bodies.end(), oblique)) {
    if (planes.normal[1]) return "symmetry: the plane y = 0 is the only one of an oblique impact\n";
    return variant("an oblique impact in the x-z plane is symmetric about the plane y = 0", "y", {"y"});
  }
  if (planes.axis) return "symmetry: rotational; cracks along a radius need a quarter or the whole body\n";
  std::string text;
  if (!(planes.normal[0] && planes.normal[1]))
    text += variant("a normal impact on a round body needs a quarter only", "x, y", {"x", "y"});
  if (subject.main.reinforcement.present()) return text; // bars have no rotational symmetry
  if (subject.main.filling.filling.layout == Layout::polar && is_round(subject.main.solid_shape()))
    text += variant("without radial cracks a half plane around the axis is enough, for screening", "axis",
                    {"axis"});
  return text;
}

std::string grading_lines(const SceneInputs& scene, const Subject& subject, double fine) {
  const Filling& filling = subject.main.filling.filling;
  if (filling.layout == Layout::lattice || subject.projectile == nullptr || scene.planes().axis) return "";
  const Shape target = subject.main.solid_shape(), shot = subject.projectile->solid_shape();
  if (!std::holds_alternative<Cylinder>(target)) return "";
  const double radius = extent(shot, {1, 0, 0}), height = extent(target, {0, 0, 1}),
               target_radius = extent(target, {1, 0, 0});
  std::string text;
  const auto graded = [&](double spacing) {
    SceneInputs other = scene;
    for (BodyInputs& body : other.bodies)
      if (body.name == subject.main.name) {
        const double coarse = filling.grading.used() ? filling.grading.coarse_spacing : height / 7;
        body.filling.filling.rings = body.filling.filling.layers = 0;
        body.filling.filling.grading = {.fine_spacing = spacing,
                                        .fine_radius = 2.4 * radius,
                                        .coarse_spacing = std::max(coarse, spacing)};
        const std::size_t points = make_points(other, body.name).owned;
        const double uniform = std::numbers::pi * target_radius * target_radius * height /
                               std::pow(spacing, 3) / scene.planes().multiplicity();
        text += line(
            "grading: %.1f mm around the path (%.1f points over the projectile's radius), %.1f mm at the "
            "rim: %zu points instead of %.0f",
            spacing * 1e3, radius / spacing, body.filling.filling.grading.coarse_spacing * 1e3, points,
            uniform);
      }
  };
  if (!filling.grading.used() && fine < height / 7) graded(fine);
  for (const double across : {fewest_across, good_across})
    if (radius / fine < 0.99 * across) graded(radius / across);
  return text;
}

std::string rigid_line(const Subject& subject) {
  if (subject.projectile == nullptr) return "";
  const double strength = subject.main.material.strength_limit() * 1e-6;
  const char* name = subject.projectile->name.c_str();
  const char* target = subject.main.name.c_str();
  if (subject.projectile->is_deformable())
    return line("%s: deformable, yields at %.0f MPa; the %s carries at most %.0f MPa of stress difference: "
                "if that is "
                "less, a rigid one (%s/Model = rigid) gives nearly the same result",
                name, subject.projectile->material.strength_limit() * 1e-6, target, strength, name);
  return line(
      "%s: rigid, six unknowns at most; the %s carries at most %.0f MPa of stress difference, so a casing of "
      "higher yield stress hardly deforms",
      name, target, strength);
}

std::string warnings(const Simulation& run, const Subject& subject, const RunInputs& inputs) {
  std::string text;
  for (const std::string& warning : run.health.warnings) text += "warning: " + warning + "\n";
  const double support = inputs.solid.approximation.support.normalized_size;
  if (inputs.solid.approximation.order == 1 && (support < smallest_support || support > largest_support))
    text += line("warning: Approximation/Support size = %.3g is outside the measured %.3g to %.3g", support,
                 smallest_support, largest_support);
  const double largest = subject.main.material.softens() ? largest_step_concrete : largest_step_metal;
  if (inputs.time.step_factor > largest)
    text += line("warning: Time/Step factor = %.3g is above the largest that has been measured, %.3g",
                 inputs.time.step_factor, largest);
  return text;
}

} // namespace

std::string make_plan(const SceneInputs& scene, const RunInputs& inputs, const std::string& file) {
  Simulation run = make_simulation(scene, inputs);
  check_bodies(run, inputs.solid, file);
  const Answers answers(inputs.answers, scene, inputs.fragments, file);
  check_shots(run, scene, answers, file);
  const Subject subject{*scene.find(answers.main_body()), answers.moving_body() == answers.main_body()
                                                              ? nullptr
                                                              : scene.find(answers.moving_body())};
  const std::vector<double>& spacing = run.bodies.solid(answers.main_body())->points.spacing;
  const double fine = *std::min_element(spacing.begin(), spacing.end());
  return body_lines(run) + answers.numerical_errors(run) + cost_lines(answers, inputs, run) +
         symmetry_lines(scene, subject) + grading_lines(scene, subject, fine) + rigid_line(subject) +
         warnings(run, subject, inputs);
}

} // namespace spall
