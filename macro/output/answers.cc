#include "macro/output/answers.h"

#include "macro/output/quantile.h"
#include "macro/output/witness_answers.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace spall {

BarShape measure_bar(const Solid& solid, const SceneInputs& inputs) {
  const Points& points = solid.points;
  // Points inside the surface stand for half a cell more, stretched like the point.
  const double half = inputs.filling.boundary == Boundary::on_surface ? 0 : 0.5;
  double low = 1e300, high = -1e300, radius = 0;
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
  return {.length = ranks.max(high) - ranks.min(low),
          .foot_diameter = 2 * ranks.max(radius),
          .max_plastic_strain = ranks.max(largest),
          .plastic_strain_95 = weighted_quantile(strain, points.volume, 0.95 * volume, ranks),
          .mean_plastic_strain = ranks.sum(mean) / volume};
}

Perforation measure_perforation(const Simulation& run, const SceneInputs& inputs,
                                const FragmentInputs& fragments) {
  const ProjectileState projectile = projectile_of(run);
  Fragments found = find_fragments(*run.solids[0], fragments, inputs.height);
  const Craters craters = measure_craters(*run.solids[0], found, inputs.height, 0.5 * inputs.diameter);
  const Exit& exit = run.exit;
  return {.velocity = exit.happened() ? exit.speed : projectile.speed(),
          .time = exit.happened() ? exit.time : run.time,
          .perforated = exit.happened() || (projectile.rear > inputs.height && projectile.speed() > 0),
          .projectile = projectile,
          .momentum = run.momentum_error(),
          .ogive_length = inputs.projectile.length,
          .ogive_radius = 0.5 * inputs.projectile.diameter,
          .fragments = std::move(found),
          .craters = craters};
}

Answers measure_answers(const Simulation& run, const SceneInputs& inputs, const FragmentInputs& fragments) {
  if (inputs.kind == SceneKind::taylor) return measure_bar(*run.solids[0], inputs);
  return measure_perforation(run, inputs, fragments);
}

namespace {

double percent_lost(double in, double out) { return 100 * (in - out) / in; }

/// Of the kinetic energy; one that comes back (out < 0) has lost more than all of it.
double percent_energy_lost(double in, double out) { return 100 * (1 - out * std::abs(out) / (in * in)); }

void add(Summary& summary, const BarShape& bar, const Simulation&, const SceneInputs& inputs) {
  summary.set("final_length_ratio", bar.length / inputs.height);
  summary.set("foot_diameter", bar.foot_diameter);
  summary.set("max_plastic_strain", bar.max_plastic_strain);
  summary.set("plastic_strain_95", bar.plastic_strain_95);
  summary.set("mean_plastic_strain", bar.mean_plastic_strain);
}

void add(Summary& summary, const Perforation& p, const Simulation& run, const SceneInputs& inputs) {
  const double in = inputs.impact_velocity, out = p.velocity;
  summary.set("thickness", inputs.height);
  summary.set("diameter", inputs.diameter);
  // Unknown while the projectile is still in the slab.
  summary.set("exit_velocity", p.perforated ? out : out <= 0 ? 0.0 : std::nan(""));
  summary.set("final_velocity", p.projectile.speed()); // behind a witness plate, if there is one
  summary.set("delta_v_percent", percent_lost(in, out));
  summary.set("delta_ke_percent", percent_energy_lost(in, out));
  summary.set("absorbed_energy", 0.5 * inputs.projectile.mass * (in * in - out * out));
  summary.set("perforated", p.perforated);
  summary.set("time_of_exit", p.perforated ? p.time : std::nan(""));
  summary.set("front_crater_diameter", p.craters.front.mean_diameter);
  summary.set("back_crater_diameter", p.craters.back.mean_diameter);
  summary.set("front_crater_largest_diameter", p.craters.front.largest_diameter);
  summary.set("back_crater_largest_diameter", p.craters.back.largest_diameter);
  summary.set("projectile_mass", inputs.projectile.mass);
  if (!inputs.flight().is_normal()) {
    summary.set("obliquity", inputs.obliquity);
    summary.set("angle_of_attack", inputs.attack);
    summary.set("final_direction", std::atan2(p.projectile.velocity[0], p.projectile.velocity[2]));
    summary.set("final_axis", std::atan2(p.projectile.axis[0], p.projectile.axis[2]));
    summary.set("final_angular_velocity", p.projectile.turning[1]);
  }
  summary.set("linear_momentum_error", p.momentum.linear);
  summary.set("angular_momentum_error", p.momentum.angular);
  summary.set("projectile_radius", p.ogive_radius);
  summary.set("projectile_length", p.ogive_length);
  add_witness(summary, run);
  add_fragments(summary, p.fragments, run.solids[0]->ghosts.symmetry());
}

} // namespace

void add_answers(Summary& summary, const Answers& answers, const Simulation& run, const SceneInputs& inputs) {
  std::visit([&](const auto& a) { add(summary, a, run, inputs); }, answers);
}

void write_tables(const std::filesystem::path& directory, const Answers& answers) {
  const Perforation* p = std::get_if<Perforation>(&answers);
  if (p == nullptr) return;
  write_fragments(directory / "fragments.csv", p->fragments);
  write_craters(directory, p->craters);
}

std::string in_words(const Answers& answers, const SceneInputs& inputs) {
  char text[300];
  if (const BarShape* bar = std::get_if<BarShape>(&answers)) {
    std::snprintf(
        text, sizeof text,
        "L/L0 %.4f, foot diameter %.2f mm, plastic strain: 95 %% quantile %.3f, mean %.4f, largest %.2f",
        bar->length / inputs.height, bar->foot_diameter * 1e3, bar->plastic_strain_95,
        bar->mean_plastic_strain, bar->max_plastic_strain);
  } else {
    const Perforation& p = std::get<Perforation>(answers);
    const double in = inputs.impact_velocity, out = p.velocity;
    const FragmentSums debris = sum_of(p.fragments, FragmentPlace::debris),
                       ejecta = sum_of(p.fragments, FragmentPlace::ejecta);
    std::snprintf(text, sizeof text,
                  "velocity %.1f m/s after %.1f m/s at impact: change %.1f %%, kinetic energy %.1f %%; "
                  "%.0f fragments (%.2f kg) behind the slab, %.0f (%.2f kg) before it",
                  out, in, percent_lost(in, out), percent_energy_lost(in, out), debris.count, debris.mass,
                  ejecta.count, ejecta.mass);
  }
  return text;
}

} // namespace spall
