// Shoots a scene: reads SCENE.prm, advances it explicitly, writes history, fields and summary.

#include "macro/dynamics/projectile_state.h"
#include "macro/output/frames.h"
#include "macro/output/history.h"
#include "macro/output/run_summary.h"
#include "macro/scene_simulation.h"
#include "shared/output_directory.h"
#include "shared/program.h"
#include "shared/progress.h"
#include "shared/version.h"

#include <tbb/global_control.h>

#include <cmath>
#include <cstdio>
#include <filesystem>

namespace spall {
namespace {

const char* const usage = "usage: penetrate SCENE.prm [--output DIR] [Section/Key=value ...]\n"
                          "Writes history.csv, fields.h5 and fields.xdmf (ParaView), summary.json and "
                          "resolved.prm into DIR (default out).\n"
                          "Exit codes: 0 done, 2 bad input, 3 computation failed, 130 interrupted.\n";

/// True when the scene has shown what it is for.
bool finished(const Simulation& run, const SceneInputs& scene) {
  if (scene.kind == SceneKind::taylor) return run.budget.solid_momentum[0] >= 0; // the bar rebounds
  const ProjectileState projectile = projectile_of(run);
  return projectile.velocity[2] <= 0 || projectile.rear > scene.height; // stopped, or the tail is out
}

/// Part of the way to finished() or to the end time, whichever is nearer: for the remaining time.
double part_done(const Simulation& run, const SceneInputs& scene, double end_time) {
  const double by_time = run.time / end_time;
  if (scene.kind == SceneKind::taylor)
    return std::max(by_time, 1 - run.budget.solid_momentum[0] / run.budget.initial_momentum);
  const ProjectileState projectile = projectile_of(run);
  const double time_left = // at the velocity it has
      (scene.height - projectile.rear) / std::max(projectile.velocity[2], 1e-9);
  return std::max(by_time, run.time / (run.time + time_left));
}

std::string progress_line(const Simulation& run, double done, double wall) {
  char text[160];
  std::snprintf(text, sizeof text,
                "t %.1f us  step %zu  %.2f M point-steps/s  about %s left  energy error %.2e", run.time * 1e6,
                run.steps, 1e-6 * static_cast<double>(run.point_count() * run.steps) / std::max(wall, 1e-9),
                format_duration(wall * (1 - done) / std::max(done, 1e-9)).c_str(), run.budget.error());
  return text;
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
  parameters.read(line.input, line.overrides);
  scene.validate(line.input);
  inputs.validate(line.input);
  RunRecord record{.provenance = make_provenance("penetrate", line.input, parameters.resolved()),
                   .scheme = name_of(inputs.solid.integration.scheme)};

  std::unique_ptr<tbb::global_control> threads;
  if (inputs.threads > 0)
    threads =
        std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism, inputs.threads);
  Simulation simulation = make_simulation(scene, inputs);

  const std::filesystem::path directory = line.output;
  make_output_directory(directory);
  write_atomically(directory / "resolved.prm", record.provenance.input);
  std::filesystem::remove(directory /
                          "summary.json"); // an older run's answers must not stand beside new fields
  std::printf("penetrate %s: %s, %zu points, spacing %.2f mm, %s\n", version, line.input.c_str(),
              simulation.point_count(), simulation.solids[0]->points.spacing.front() * 1e3,
              record.scheme.c_str());

  History history(directory);
  Frames frames(directory, simulation, scene.kind == SceneKind::slab ? "slab" : "taylor", scene.height,
                record.provenance);
  frames.write(simulation);
  history.write(simulation);
  Progress progress;
  timer.split(record.setup);
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
      timer.split(record.output);
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
  record.wall = watch.seconds();
  record.processor = watch.cpu_seconds();
  const bool stopped = failure.empty() && interrupted();
  record.ended = !failure.empty()                         ? "failed: " + failure
                 : stopped                                ? "interrupted"
                 : simulation.time < inputs.time.end_time ? "finished"
                                                          : "end time";
  history.write(simulation);
  frames.write(simulation);
  simulation.look_for_defects();
  const Answers answers = measure_answers(simulation, scene);
  summarize(simulation, scene, record, answers).write(directory / "summary.json");
  print_result(simulation, scene, record, answers);
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
