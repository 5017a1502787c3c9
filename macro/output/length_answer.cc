#include "macro/output/length_answer.h"

#include "macro/output/quantile.h"
#include "macro/scene/placement.h"
#include "shared/error.h"
#include "shared/input/quantity.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace spall {

BarShape measure_bar(const Solid& solid, Boundary boundary) {
  const Points& points = solid.points;
  // Beyond points inside the surface there is half a cell more, stretched with the point's deformation.
  const double half = boundary == Boundary::on_surface ? 0 : 0.5;
  double low = std::numeric_limits<double>::infinity(), high = -low, radius = 0;
  for (std::size_t i = 0; i < points.owned; ++i) {
    const Mat3 f = points.deformation(i);
    const Vec3 x = points.position[i];
    const double reach = half * points.spacing[i] * std::hypot(f[6], f[7], f[8]);
    low = std::min(low, x[2] - reach);
    high = std::max(high, x[2] + reach);
    if (points.faces[i] & low_face)
      radius =
          std::max(radius, std::hypot(x[0], x[1]) +
                               half * points.spacing[i] *
                                   std::sqrt(0.5 * (f[0] * f[0] + f[1] * f[1] + f[3] * f[3] + f[4] * f[4])));
  }
  const std::vector<double> strain = solid.field("plastic_strain");
  double volume = 0, mean = 0, largest = 0;
  for (std::size_t i = 0; i < points.owned; ++i) {
    volume += points.volume[i], mean += points.volume[i] * strain[i];
    largest = std::max(largest, strain[i]);
  }
  const Ranks& ranks = solid.ghosts.processes();
  volume = ranks.sum(volume);
  low = ranks.min(low), high = ranks.max(high);
  return {.length = volume > 0 ? high - low : std::nan(""),
          .foot_diameter = 2 * ranks.max(radius),
          .max_plastic_strain = ranks.max(largest),
          .plastic_strain_95 = weighted_quantile(strain, points.volume, 0.95 * volume, ranks),
          .mean_plastic_strain = ranks.sum(mean) / volume};
}

namespace {

/// Whether a body and one above or below it fly at each other.
bool meets_another(const BodyInputs& bar, const SceneInputs& scene, const std::string& file) {
  const auto places = place_bodies(scene, file);
  const Placed& own = places.at(bar.name);
  return std::any_of(scene.bodies.begin(), scene.bodies.end(), [&](const BodyInputs& other) {
    if (&other == &bar || !places.contains(other.name)) return false;
    const double closing = bar.motion.velocity - other.motion.velocity;
    return places.at(other.name).lowest + places.at(other.name).highest > own.lowest + own.highest
               ? closing > 0
               : closing < 0;
  });
}

} // namespace

LengthAnswer::LengthAnswer(const std::vector<std::string>& bodies, const SceneInputs& scene,
                           const FragmentInputs&, const std::string& file)
    : BodyAnswer(bodies[0]) {
  const BodyInputs& bar = inputs_of_body(name, scene, file);
  const Shape form = bar.solid_shape();
  length = extent(form, {0, 0, 1}) + extent(form, {0, 0, -1});
  radius = extent(form, {1, 0, 0});
  velocity = bar.motion.velocity;
  if (velocity == 0) throw InputError(file + ": key 'Answers/Length': the body '" + body + "' does not move");
  if (!meets_another(bar, scene, file))
    throw InputError(file + ": key 'Answers/Length': the body '" + body + "' flies away from all others (" +
                     body + "/Velocity = " + format_quantity(velocity, Dimension::velocity) + ")");
  momentum = bar.total_mass() * velocity / scene.planes().multiplicity();
  elastic_time = 2 * length / std::sqrt(bar.material.youngs_modulus() / bar.material.density());
  boundary = bar.filling.filling.boundary;
  if (scene.contact_order().size() > 1) unmeasured = "a bar beside another deformable body";
  if (bar.material.law() != J2::name) unmeasured = "a bar of the law " + bar.material.law();
  if (bar.material.softens()) unmeasured = "a bar that softens";
}

std::optional<NumericalError> LengthAnswer::numerical_error(const Simulation& run) const {
  if (!unmeasured.empty()) return not_measured("shortening", unmeasured);
  return error_of_shortening(numerics_of(run, *run.bodies.solid(body), radius));
}

double LengthAnswer::momentum_left(const Simulation& run) const {
  return run.energies.solid_momentum[run.bodies.index(body)] / momentum;
}

Settlement LengthAnswer::settlement(const Simulation& run) const {
  const std::string values = "length, diameter, plastic strain";
  return settled(run) ? Settlement{values, ""} : Settlement{"", values};
}

void LengthAnswer::add_to(Summary& summary, const Simulation&, const std::string& prefix) const {
  summary.set(prefix + "bar", body);
  summary.set(prefix + "impact_velocity", std::abs(velocity));
  summary.set(prefix + "final_length_ratio", shape.length / length);
  ratios().add_to(summary, prefix + "final_length_ratio");
  error.add_to(summary, prefix);
  summary.set(prefix + "foot_diameter", shape.foot_diameter);
  summary.set(prefix + "max_plastic_strain", shape.max_plastic_strain);
  summary.set(prefix + "plastic_strain_95", shape.plastic_strain_95);
  summary.set(prefix + "mean_plastic_strain", shape.mean_plastic_strain);
}

std::string LengthAnswer::in_words() const {
  char text[300];
  std::snprintf(
      text, sizeof text,
      "L/L0 %.4f%s, foot diameter %.2f mm, plastic strain: 95 %% quantile %.3f, mean %.4f, largest %.2f",
      shape.length / length, ratios().in_words(4).c_str(), shape.foot_diameter * 1e3, shape.plastic_strain_95,
      shape.mean_plastic_strain, shape.max_plastic_strain);
  return text + ("\nnumerical error: " + error.in_words(body));
}

} // namespace spall
