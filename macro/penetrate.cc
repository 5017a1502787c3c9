// Shoots a scene: reads SCENE.prm, advances it explicitly, writes history, fields and summary.

#include "macro/dynamics/simulation.h"
#include "macro/output/answers.h"
#include "macro/output/frames.h"
#include "macro/output/history.h"
#include "macro/scene_simulation.h"
#include "shared/output_directory.h"
#include "shared/program.h"
#include "shared/progress.h"
#include "shared/version.h"

#include <tbb/global_control.h>
#include <tbb/info.h>

#include <cmath>
#include <cstdio>
#include <filesystem>

namespace spall {
namespace {

const char* const usage = "usage: penetrate SCENE.prm [--output DIR] [Section/Key=value ...]\n"
                          "Writes history.csv, fields.h5 and fields.xdmf (ParaView), summary.json and "
                          "resolved.prm into DIR (default out).\n"
                          "Exit codes: 0 done, 2 bad input, 3 computation failed, 130 interrupted.\n";

/// Wall time outside the steps, s.
struct OuterTimes {
  double setup = 0; ///< input, points, first fields
  double output = 0;
};

/// True when the scene has shown what it is for.
bool finished(const Simulation& run, const SceneInputs& scene) {
  if (scene.kind == SceneKind::taylor) return run.budget.solid_momentum[0] >= 0; // the bar rebounds
  const Ogive& ogive = std::get<Ogive>(run.body.shape);
  return run.body.velocity[2] <= 0 ||
         run.body.position[2] - ogive.length > scene.height; // stopped, or the tail is out
}

/// Part of the way to finished() or to the end time, whichever is nearer: for the remaining time.
double part_done(const Simulation& run, const SceneInputs& scene, double end_time) {
  const double by_time = run.time / end_time;
  if (scene.kind == SceneKind::taylor)
    return std::max(by_time, 1 - run.budget.solid_momentum[0] / run.budget.initial_momentum);
  const Ogive& ogive = std::get<Ogive>(run.body.shape);
  const double way_left = ogive.length + scene.height - run.body.position[2];
  const double time_left = way_left / std::max(run.body.velocity[2], 1e-9); // at the velocity it has
  return std::max(by_time, run.time / (run.time + time_left));
}

Summary summarize(const Simulation& run, const SceneInputs& scene, const RunInputs& inputs,
                  const Provenance& provenance, const Stopwatch& watch, const OuterTimes& outer,
                  const std::string& ended) {
  const double wall = watch.seconds();
  const Budget& b = run.budget;
  const std::size_t n = run.point_count();
  Summary s;
  s.set("program", "penetrate");
  s.set("version", version);
  s.set("input_file", provenance.input_file);
  s.set("created", provenance.created);
  s.set("scene", scene.kind == SceneKind::slab ? "slab" : "taylor");
  s.set("ended", ended);
  s.set("material", scene.law == Law::AFC ? "AFC" : "J2");
  s.set("damage_table", scene.law == Law::AFC ? scene.afc.damage_table : std::string());
  s.set("scheme", name_of(inputs.solid.integration.scheme));
  if (scene.kind == SceneKind::taylor) s.set("anvil", scene.anvil.deformable ? "deformable" : "rigid wall");
  if (run.solids.size() > 1) s.set("contact_scheme", name_of(scene.contact.scheme));
  s.set("points", n);
  s.set("points_whole_body", static_cast<double>(n) * scene.planes().multiplicity());
  s.set("spacing", run.solids[0]->points.spacing.front());
  s.set("steps", run.steps);
  s.set("refreshes", run.refreshes);
  s.set("refreshed_points", run.refreshed_points);
  s.set("simulated_time", run.time);
  s.set("wall_seconds", wall);
  s.set("cpu_seconds", watch.cpu_seconds());
  s.set("points_steps_per_second", wall > 0 ? static_cast<double>(n * run.steps) / wall : 0.0);
  s.set("seconds_setup", outer.setup);
  s.set("seconds_refresh", run.phases.refresh);
  s.set("seconds_stresses", run.phases.stresses);
  s.set("seconds_contact", run.phases.contact);
  s.set("seconds_motion", run.phases.motion);
  s.set("seconds_output", outer.output);
  s.set("peak_memory_bytes", peak_memory_bytes());
  std::size_t bytes = 0;
  for (const auto& solid : run.solids) bytes += solid->memory_bytes();
  s.set("model_memory_bytes", bytes);
  s.set("bytes_per_point", static_cast<double>(bytes) / static_cast<double>(n));
  s.set("ranks", 1);
  s.set("threads",
        static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism)));
  s.set("energy_balance_error", std::abs(b.error()));
  const double change = b.momentum - b.initial_momentum;
  // A held wall takes momentum without bound: then it is the impulse that must equal the change.
  const double unbalanced = std::isinf(run.body.mass) ? change - b.impulse : change;
  s.set("momentum_balance_error",
        std::abs(b.impulse) > 0 ? std::abs(unbalanced / b.impulse) : std::abs(unbalanced));
  s.set("stabilization_work_fraction", b.initial_energy > 0 ? b.stabilization / b.initial_energy : 0.0);
  s.set("friction_loss_fraction", b.initial_energy > 0 ? b.friction / b.initial_energy : 0.0);
  s.set("contact_loss_fraction", b.initial_energy > 0 ? b.contact / b.initial_energy : 0.0);
  s.set("smallest_step_margin", run.smallest_step_margin);
  s.set("step_reductions", run.step_reductions);
  s.set("damping_loss_fraction", b.initial_energy > 0 ? b.damping / b.initial_energy : 0.0);
  s.set("plastic_strain_saw_tooth", run.roughness.plastic_saw_tooth);
  s.set("position_saw_tooth", run.roughness.position_saw_tooth);
  s.set("volume_mismatch", run.roughness.volume_mismatch);
  s.set("volume_alternation", run.roughness.volume_alternation);
  s.set("smallest_moment_fraction", run.smallest_moment_fraction);
  s.set("largest_energy_error", run.largest_energy_error);
  std::string warnings;
  for (const std::string& warning : run.warnings) warnings += (warnings.empty() ? "" : "; ") + warning;
  s.set("warnings", warnings);
  s.set("most_regularized_points", run.most_regularized);
  s.set("most_isolated_points", run.most_isolated);
  s.set("deepest_overlap", run.deepest_overlap);
  s.set("contact_gap_mean", run.mean_contact_gap());
  s.set("contact_gap_max", run.contact_gap_max);
  s.set("impact_velocity", scene.impact_velocity);
  add_answers(s, run, scene);
  return s;
}

std::string progress_line(const Simulation& run, double done, double wall) {
  char text[160];
  std::snprintf(text, sizeof text,
                "t %.1f us  step %zu  %.2f M point-steps/s  about %s left  energy error %.2e", run.time * 1e6,
                run.steps, 1e-6 * static_cast<double>(run.point_count() * run.steps) / std::max(wall, 1e-9),
                format_duration(wall * (1 - done) / std::max(done, 1e-9)).c_str(), run.budget.error());
  return text;
}

void print_answers(const Simulation& run, const SceneInputs& scene, double wall) {
  if (scene.kind == SceneKind::taylor) {
    const BarShape bar = measure_bar(*run.solids[0], scene);
    std::printf(
        "L/L0 %.4f, foot diameter %.2f mm, plastic strain: 95 %% quantile %.3f, mean %.4f, largest %.2f\n",
        bar.length / scene.height, bar.foot_diameter * 1e3, bar.plastic_strain_95, bar.mean_plastic_strain,
        bar.max_plastic_strain);
  } else {
    const double in = scene.impact_velocity, out = run.body.velocity[2];
    std::printf("velocity %.1f m/s after %.1f m/s at impact: change %.1f %%, kinetic energy %.1f %%\n", out,
                in, 100 * (in - out) / in, 100 * (1 - out * std::abs(out) / (in * in)));
  }
  std::printf("%zu steps to t = %.1f us in %s, %.2f M point-steps/s, energy error %.2e\n", run.steps,
              run.time * 1e6, format_duration(wall).c_str(),
              1e-6 * static_cast<double>(run.point_count() * run.steps) / std::max(wall, 1e-9),
              run.budget.error());
}

ExitCode run(const CommandLine& line) {
  SceneInputs scene;
  RunInputs inputs;
  Parameters parameters;
  scene.declare(parameters);
  inputs.declare(parameters);
  if (line.help) {
    std::printf("%s%s", usage, parameters.help().c_str());
    return ExitCode::done;
  }
  if (line.input.empty() || !line.more.empty())
    throw InputError(std::string("one scene file is needed\n") + usage);
  if (line.restart) throw InputError("--restart: this version writes no checkpoints to restart from");
  PhaseTimer timer;
  OuterTimes outer;
  parameters.read(line.input, line.overrides);
  scene.validate(line.input);
  inputs.validate(line.input);
  const Provenance provenance = make_provenance("penetrate", line.input, parameters.resolved());

  std::unique_ptr<tbb::global_control> threads;
  if (inputs.threads > 0)
    threads =
        std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism, inputs.threads);
  Simulation simulation = make_simulation(scene, inputs);

  const std::filesystem::path directory = line.output;
  make_output_directory(directory);
  write_atomically(directory / "resolved.prm", provenance.input);
  std::filesystem::remove(directory /
                          "summary.json"); // an older run's answers must not stand beside new fields
  std::printf("penetrate %s: %s, %zu points, spacing %.2f mm, %s\n", version, line.input.c_str(),
              simulation.point_count(), simulation.solids[0]->points.spacing.front() * 1e3,
              name_of(inputs.solid.integration.scheme));

  History history(directory);
  Frames frames(directory, simulation, scene.kind == SceneKind::slab ? "slab" : "taylor", scene.height,
                provenance);
  frames.write(simulation);
  history.write(simulation);
  Progress progress;
  timer.split(outer.setup);
  const Stopwatch watch;
  double next_frame = inputs.frame_interval, next_history = 0;
  std::string failure;
  try {
    while (simulation.time < inputs.time.end_time && !finished(simulation, scene) && !interrupted()) {
      simulation.advance();
      timer.restart();
      if (simulation.time >= next_history) history.write(simulation), next_history += inputs.history_interval;
      if (simulation.time >= next_frame) {
        frames.write(simulation);
        next_frame += inputs.frame_interval;
      }
      timer.split(outer.output);
      if (std::abs(simulation.budget.error()) > inputs.energy_tolerance)
        throw ComputationError("t = " + std::to_string(simulation.time * 1e6) + " us: the energy error " +
                               std::to_string(simulation.budget.error()) + " exceeds Run/Energy tolerance");
      if (progress.due())
        progress.show(
            progress_line(simulation, part_done(simulation, scene, inputs.time.end_time), watch.seconds()));
    }
  } catch (const ComputationError& error) {
    failure = error.what();
  }
  progress.clear();
  const double wall = watch.seconds();
  const bool stopped = failure.empty() && interrupted();
  const std::string ended = !failure.empty()                         ? "failed: " + failure
                            : stopped                                ? "interrupted"
                            : simulation.time < inputs.time.end_time ? "finished"
                                                                     : "end time";
  history.write(simulation);
  frames.write(simulation);
  simulation.look_for_defects();
  for (const std::string& warning : simulation.warnings) std::printf("warning: %s\n", warning.c_str());
  summarize(simulation, scene, inputs, provenance, watch, outer, ended).write(directory / "summary.json");
  print_answers(simulation, scene, wall);
  std::printf("results in %s\n", directory.c_str());
  if (!failure.empty())
    throw ComputationError(failure + "; everything up to then is in " + directory.string());
  if (stopped) {
    std::fprintf(stderr, "penetrate: interrupted at t = %.1f us, results so far are in %s\n",
                 simulation.time * 1e6, directory.c_str());
    return ExitCode::interrupted;
  }
  return ExitCode::done;
}

} // namespace
} // namespace spall

int main(int argc, char** argv) {
  return spall::run_program("penetrate", [&] { return spall::run(spall::parse_command_line(argc, argv)); });
}
