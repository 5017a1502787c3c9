#include "macro/setup/alternatives.h"

#include "macro/output/answers.h"
#include "macro/setup/make_simulation.h"
#include "shared/error.h"
#include "shared/progress.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace spall {
namespace {

/// Points over the radius of the projectile at which set U was measured: 11, 8 and 5.3 mm over 25.4 mm; and
/// rings of the measured bars.
constexpr double points_across[] = {25.4 / 11, 25.4 / 8, 25.4 / 5.3};
constexpr int rings_of_bars[] = {5, 10, 20};

/// Grading of the measured models: fine over 150 mm for a radius of 25.4 mm, coarse cells a seventh of the
/// thickness.
constexpr double fine_radii = 150 / 25.4, coarse_layers = 7, growth = 1.15;

/// Simulated time until the answer has settled: in units of thickness / velocity, and of the time in which an
/// elastic wave goes along a bar and back. From the 127 mm slabs and the aluminium bar; a shot that nearly
/// stops takes three times as long.
constexpr double passages = 1.5, echoes = 3.3;

/// Processor time per point and per step of h / c, s, with all that a run does: 127 mm slab around the axis
/// and as a graded quarter, aluminium bar. More than the time per real step, as crushed cells shorten the
/// step.
constexpr double cost_axis = 14e-6, cost_quarter = 13e-6, cost_bar = 1.2e-6;

/// The settings of the measured runs (data/scenes/parts/slab.prm, graded.prm,
/// data/scenes/taylor_aluminium.prm).
const std::vector<std::string> concrete = {"Integration/Scheme=SUBPOINT",
                                           "Integration/Refresh interval=4",
                                           "Integration/Refresh deformation=0.05",
                                           "Integration/Least deformation=0.001",
                                           "Approximation/Support size=1.9",
                                           "Approximation/Smallest stretch=0.2",
                                           "Approximation/Largest stretch=1.5",
                                           "Time/Step factor=0.6",
                                           "Time/Subcycles=4"};
const std::vector<std::string> metal = {"Integration/Scheme=NSNI", "Integration/Stabilization=0.05",
                                        "Time/Step factor=0.7"};

/// What the first answer is about.
struct Subject {
  std::string body; ///< target or bar
  double radius;    ///< of the projectile or bar, m
  double thickness; ///< of the target, or length of the bar, m
  double width;     ///< radius of the body, m
  double time;      ///< simulated time that the answer takes, s
  double sound;     ///< speed, m/s
  bool shot, all;   ///< all: craters and fragments too
};

Subject subject_of(const SceneFile& file, const std::string& name) {
  const SceneInputs& scene = file.scene;
  const Answers answers(file.run.answers, scene, file.run.fragments, name);
  const BodyInputs& body = *scene.find(answers.main_body());
  const Shape shape = body.solid_shape();
  const bool shot = !answers.shots().empty(), bar = !shot && !answers.empty() && body.motion.velocity != 0;
  const bool others = std::any_of(scene.bodies.begin(), scene.bodies.end(), [&](const BodyInputs& other) {
    return other.is_deformable() && other.name != body.name && other.name != answers.moving_body();
  });
  if (!std::holds_alternative<Cylinder>(shape) || body.filling.filling.layout == Layout::lattice ||
      !(shot || bar) || others || body.reinforcement.present())
    throw InputError(
        name +
        ": key 'Run/Accuracy': errors have been measured for one round target without reinforcing bars "
        "and its projectile and for round bars, filled with rings of points, which this scene is not");
  const BodyInputs& moving = *scene.find(answers.moving_body());
  const double height = extent(shape, {0, 0, 1}) + extent(shape, {0, 0, -1}),
               sound = std::sqrt(body.material.youngs_modulus() / body.material.density());
  return {.body = body.name,
          .radius = extent(moving.solid_shape(), {1, 0, 0}),
          .thickness = height,
          .width = extent(shape, {1, 0, 0}),
          .time = shot ? passages * height / std::abs(moving.motion.velocity) : echoes * 2 * height / sound,
          .sound = sound,
          .shot = shot,
          .all = file.run.answers.until == Until::answered};
}

template<class... Values> std::string text_of(const char* format, Values... values) {
  char text[200];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

/// Keys that give a body rings and layers, or a grading, with cells of a spacing.
std::vector<std::string> filling_keys(const Subject& of, double spacing) {
  const std::string b = of.body + "/";
  if (!of.shot)
    return {b + text_of("Rings=%d", static_cast<int>(std::lround(of.width / spacing))),
            b + text_of("Layers=%d", static_cast<int>(std::lround(of.thickness / spacing)))};
  return {b + "Rings=0",
          b + "Layers=0",
          b + text_of("Fine spacing=%.6g mm", spacing * 1e3),
          b + text_of("Fine radius=%.6g mm", std::min(fine_radii * of.radius, of.width) * 1e3),
          b + text_of("Growth=%.3g", growth),
          b + text_of("Coarse spacing=%.6g mm", std::max(of.thickness / coarse_layers, spacing) * 1e3)};
}

Alternative alternative(const Subject& of, double spacing, bool axis, const std::filesystem::path& file,
                        std::vector<std::string> overrides) {
  Alternative made;
  made.model = text_of(axis ? "around the axis, %.3g mm" : "a quarter, %.3g mm", spacing * 1e3);
  made.keys = {axis ? "Scene/Symmetry planes=axis" : "Scene/Symmetry planes=x, y"};
  for (const auto& more : {filling_keys(of, spacing), of.shot ? concrete : metal})
    made.keys.insert(made.keys.end(), more.begin(), more.end());
  overrides.insert(overrides.end(), made.keys.begin(), made.keys.end());
  const SceneFile changed(file, overrides);
  const Points points = make_points(changed.scene, of.body);
  const double smallest = *std::min_element(points.spacing.begin(), points.spacing.end());
  const IntegrationInputs& integration = changed.run.solid.integration;
  const Numerics numerics{integration.scheme, integration.stabilization, axis, of.radius / smallest,
                          changed.scene.contact.touching};
  made.points = points.owned;
  made.error = of.shot ? error_of_resistance(numerics, of.thickness / of.radius, of.thickness / of.radius)
                       : error_of_shortening(numerics);
  const double steps = of.time * of.sound / smallest;
  made.seconds =
      (of.shot ? axis ? cost_axis : cost_quarter : cost_bar) * steps * static_cast<double>(points.owned);
  return made;
}

} // namespace

std::vector<Alternative> alternatives(const std::filesystem::path& file,
                                      const std::vector<std::string>& overrides) {
  const Subject of = subject_of(SceneFile(file, overrides), file.string());
  std::vector<double> spacings;
  if (of.shot)
    for (const double across : points_across) spacings.push_back(of.radius / across);
  else
    for (const int rings : rings_of_bars) spacings.push_back(of.width / rings);
  std::vector<Alternative> all;
  for (const bool axis : {true, false}) {
    if (axis && of.shot && of.all) continue;
    NumericalError finer{.spacing = 0, .layout = 0};
    for (auto spacing = spacings.rbegin(); spacing != spacings.rend(); ++spacing) try {
        Alternative made = alternative(of, *spacing, axis, file, overrides);
        if (!made.error.known() || !made.error.remark.empty())
          continue; // finer than any that has been measured
        // A coarse model that happens to be more accurate than a finer one is so by chance.
        made.error.spacing = std::max(made.error.spacing, finer.spacing);
        made.error.layout = std::max(made.error.layout, finer.layout);
        finer = made.error;
        all.push_back(std::move(made));
      } catch (const InputError&) {
        // The scene does not have this symmetry, or its bodies have no room for such cells.
      }
  }
  if (all.empty())
    throw InputError(
        file.string() +
        ": key 'Run/Accuracy': the scene allows no symmetry for which errors have been measured");
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.seconds < b.seconds; });
  return all;
}

const Alternative& cheapest(const std::vector<Alternative>& all, double accuracy, const std::string& file) {
  for (const Alternative& one : all)
    if (one.error.relative() <= accuracy) return one;
  const auto error = [](const Alternative& one) { return one.error.relative(); };
  const Alternative& best = *std::min_element(
      all.begin(), all.end(), [&](const auto& a, const auto& b) { return error(a) < error(b); });
  throw InputError(text_of(
      "%s: key 'Run/Accuracy': found %.3g %%, allowed: %.3g %% or more, the smallest error of the %s that "
      "has been measured (%s)",
      file.c_str(), 100 * accuracy, std::ceil(1e3 * error(best)) / 10, best.error.quantity,
      best.model.c_str()));
}

std::string table_of(const std::vector<Alternative>& all) {
  std::string table =
      "alternatives: model, points, numerical error, processor time within a factor of three\n";
  for (const Alternative& one : all)
    table += text_of("  %-26s %8zu  %5.1f %% of the %s  %s\n", one.model.c_str(), one.points,
                     100 * one.error.relative(), one.error.quantity, format_duration(one.seconds).c_str());
  return table;
}

std::string in_words(const Alternative& chosen, double accuracy) {
  std::string keys;
  for (const std::string& key : chosen.keys) keys += " '" + key + "'";
  return text_of("accuracy %.3g %%: %s is the cheapest model measured to reach it: error %.1f %% of the %s, "
                 "about %s of "
                 "processor time (within a factor of three);\n  chosen:",
                 100 * accuracy, chosen.model.c_str(), 100 * chosen.error.relative(), chosen.error.quantity,
                 format_duration(chosen.seconds).c_str()) +
         keys + "\n";
}

} // namespace spall
