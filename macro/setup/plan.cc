#include "macro/setup/plan.h"

#include "macro/dynamics/projectile_state.h"
#include "macro/setup/scene_simulation.h"
#include "shared/progress.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace spall {
namespace {

/// Steps are timed for so long, s of processor time, but at least over so many refreshes.
constexpr double calibration_time = 1;
constexpr std::size_t calibration_refreshes = 3, most_calibration_steps = 2000;

/// Points over the projectile's radius from which the exit velocity of the 127 mm slab stays within 8 and
/// 4 m/s of the converged one.
constexpr double fewest_across = 3, good_across = 5;
/// Where supports and steps have been measured (data/studies): smaller supports lose their neighbours, larger
/// ones only cost; larger steps are shortened by the estimates of the stiffness, or fail where a
/// material that softens breaks.
constexpr double smallest_support = 1.8, largest_support = 2.25, largest_step_softening = 0.3,
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

/// Points of the whole body that these stand for.
double whole_points(const Points& points, const SymmetryPlanes& planes) {
  if (!planes.axis) return static_cast<double>(points.owned) * planes.multiplicity();
  double sum = 0;
  for (std::size_t i = 0; i < points.owned; ++i)
    sum += points_on_ring(points.position.component[0][i], points.spacing[i]);
  return sum;
}

std::string body_lines(const Simulation& run) {
  std::string text;
  for (const auto& solid : run.solids) {
    const Points& p = solid->points;
    const auto [fine, coarse] = std::minmax_element(p.spacing.begin(), p.spacing.end());
    text +=
        line("%s: %zu points modelled, %.0f in the whole body, spacing %s mm", solid->label.c_str(), p.owned,
             whole_points(p, solid->ghosts.symmetry()), list(*fine * 1e3, *coarse * 1e3, "%.2f").c_str());
  }
  return text;
}

/// Shortest and longest simulated time, s: a projectile that nothing slows, a bar's elastic wave forth and
/// back; the end time.
double shortest_run(const SceneInputs& scene, const Simulation& run) {
  if (scene.kind == SceneKind::slab) {
    const ProjectileState projectile = projectile_of(run);
    return (scene.height - projectile.rear) / std::max(projectile.velocity[2], 1e-9);
  }
  return 2 * scene.height / std::sqrt(scene.material.youngs_modulus() / scene.material.density());
}

std::string cost_lines(const SceneInputs& scene, const RunInputs& inputs, Simulation& run) {
  const double shortest = std::min(shortest_run(scene, run), inputs.time.end_time);
  run.advance(); // finds neighbours, and the largest stable step
  const std::size_t first = run.steps, refreshed = run.refreshes;
  const Stopwatch watch;
  while ((watch.cpu_seconds() < calibration_time || run.refreshes < refreshed + calibration_refreshes) &&
         run.steps < most_calibration_steps && run.time < inputs.time.end_time)
    run.advance();
  const double timed = static_cast<double>(std::max<std::size_t>(run.steps - first, 1));
  const double per_step = watch.cpu_seconds() / timed;
  std::size_t bytes = 0;
  for (const auto& solid : run.solids) bytes += solid->memory_bytes();
  const double points = static_cast<double>(run.point_count());
  const double few = shortest / run.step, many = inputs.time.end_time / run.step;
  std::string text = line("memory: %.1f MB, %.0f bytes per point", 1e-6 * static_cast<double>(bytes),
                          static_cast<double>(bytes) / points);
  text += line("step: %.3f us, %.3g of the largest stable one", run.step * 1e6, 1 / run.smallest_step_margin);
  text += line("steps: %.0f (%s) to %.0f (Time/End time)", few,
               scene.kind == SceneKind::slab ? "nothing slows the projectile" : "elastic wave forth and back",
               many);
  text += line("cost: %.0f ns of processor time per point and step, over %.0f steps from the start",
               1e9 * per_step / points, timed);
  text += line("processor time: %s to %s; more where much breaks, as neighbours are found again there",
               format_duration(few * per_step).c_str(), format_duration(many * per_step).c_str());
  return text;
}

/// Points of a variant of the scene's body.
std::size_t points_with(SceneInputs scene, const std::vector<std::string>& symmetry) {
  scene.symmetry = symmetry;
  return make_points(scene).owned;
}

std::string symmetry_lines(const SceneInputs& scene) {
  const SymmetryPlanes planes = scene.planes();
  const auto variant = [&](const char* why, const char* keys, const std::vector<std::string>& symmetry) {
    return line("symmetry: %s; Scene/Symmetry planes = %s has %zu points", why, keys,
                points_with(scene, symmetry));
  };
  if (scene.kind == SceneKind::slab && !scene.flight().is_normal()) {
    if (planes.normal[1]) return "symmetry: y is all that an oblique impact in the x-z plane has\n";
    return variant("an oblique impact in the x-z plane has that of the plane y = 0", "y", {"y"});
  }
  if (planes.axis) return "symmetry: rotational; cracks along a radius need a quarter or the whole body\n";
  std::string text;
  if (!(planes.normal[0] && planes.normal[1]))
    text += variant("a normal impact on a round body has that of a quarter", "x, y", {"x", "y"});
  if (scene.filling.layout == Layout::polar)
    text += variant("without radial cracks it has that of the axis, for screening", "axis", {"axis"});
  return text;
}

std::string grading_lines(const SceneInputs& scene, double fine) {
  if (scene.filling.layout == Layout::lattice || scene.kind != SceneKind::slab) return "";
  const double radius = 0.5 * scene.projectile.diameter;
  std::string text;
  const auto graded = [&](double spacing) {
    SceneInputs other = scene;
    const double coarse =
        scene.filling.grading.used() ? scene.filling.grading.coarse_spacing : scene.height / 7;
    other.filling.rings = other.filling.layers = 0;
    other.filling.grading = {.fine_spacing = spacing,
                             .fine_radius = 1.2 * scene.projectile.diameter,
                             .coarse_spacing = std::max(coarse, spacing)};
    const std::size_t points = make_points(other).owned;
    const double uniform = scene.diameter * scene.diameter * scene.height * 0.25 * 3.14159265 /
                           std::pow(spacing, 3) / scene.planes().multiplicity();
    text +=
        line("grading: %.1f mm around the path (%.1f points over the projectile's radius), %.1f mm at the "
             "rim: %zu points instead of %.0f",
             spacing * 1e3, radius / spacing, other.filling.grading.coarse_spacing * 1e3, points, uniform);
  };
  if (scene.planes().axis) return "";
  if (!scene.filling.grading.used() && fine < scene.height / 7) graded(fine);
  for (const double across : {fewest_across, good_across})
    if (radius / fine < 0.99 * across) graded(radius / across);
  return text;
}

std::string rigid_line(const SceneInputs& scene) {
  if (scene.kind == SceneKind::taylor)
    return scene.anvil.deformable
               ? "anvil: a rigid wall in its place (Anvil/Model = rigid wall) leaves out its points\n"
               : "anvil: a rigid wall, which costs nothing\n";
  const double strength = scene.material.strength_limit() * 1e-6;
  if (!std::isfinite(strength)) return "";
  if (scene.projectile.is_deformable())
    return line("projectile: deformable, yields at %.0f MPa; the slab carries at most %.0f MPa of stress "
                "difference: if that is less, a rigid one (Projectile/Model = rigid) moves nearly alike",
                scene.projectile.j2.initial_yield * 1e-6, strength);
  return line("projectile: rigid, six unknowns at most; the slab carries at most %.0f MPa of stress "
              "difference, so a casing of higher yield stress hardly deforms",
              strength);
}

std::string warnings(const SceneInputs& scene, const RunInputs& inputs, double fine) {
  std::string text;
  if (scene.kind == SceneKind::slab) {
    const double across = 0.5 * scene.projectile.diameter / fine;
    if (across < good_across)
      text += line("warning: %.1f points over the projectile's radius; exit velocities want %.0f for 8 m/s, "
                   "%.0f for 4 m/s",
                   across, fewest_across, good_across);
  }
  const double support = inputs.solid.approximation.support.normalized_size;
  if (inputs.solid.approximation.order == 1 && (support < smallest_support || support > largest_support))
    text += line("warning: Approximation/Support size = %.3g is outside the measured %.3g to %.3g", support,
                 smallest_support, largest_support);
  const double largest = scene.material.softens() ? largest_step_softening : largest_step_metal;
  if (inputs.time.step_factor > largest)
    text += line("warning: Time/Step factor = %.3g is above the largest that has been measured, %.3g",
                 inputs.time.step_factor, largest);
  return text;
}

} // namespace

std::string make_plan(SceneInputs& scene, const RunInputs& inputs) {
  Simulation run = make_simulation(scene, inputs);
  const std::vector<double>& spacing = run.solids[0]->points.spacing;
  const double fine = *std::min_element(spacing.begin(), spacing.end());
  return body_lines(run) + cost_lines(scene, inputs, run) + symmetry_lines(scene) +
         grading_lines(scene, fine) + rigid_line(scene) + warnings(scene, inputs, fine);
}

} // namespace spall
