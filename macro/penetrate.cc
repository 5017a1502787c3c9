// Shoots a scene: reads SCENE.prm, advances it explicitly, writes history, fields and summary.

#include "macro/output/frames.h"
#include "macro/output/history.h"
#include "macro/output/run_summary.h"
#include "macro/restart/checkpoint.h"
#include "macro/restart/rebalance.h"
#include "macro/setup/check_bodies.h"
#include "macro/setup/check_shots.h"
#include "macro/setup/make_simulation.h"
#include "macro/setup/plan.h"
#include "macro/setup/scene_file.h"
#include "shared/output_directory.h"
#include "shared/program.h"
#include "shared/progress.h"
#include "shared/traffic.h"
#include "shared/version.h"

#include <tbb/global_control.h>

#include <cmath>
#include <cstdio>
#include <filesystem>

namespace spall {
namespace {

const char* const usage =
    "usage: penetrate SCENE.prm [--output DIR] [--restart] [--plan] [Section/Key=value ...]\n"
    "Writes history.csv, fields.h5, fields.xdmf (ParaView) and the folder fields, "
    "summary.json, resolved.prm and checkpoint.h5 into DIR (default out).\n"
    "--restart goes on in DIR from its newest checkpoint, with the same input; sections "
    "Output and Run and the end time may differ.\n"
    "--plan says what the scene will cost, and what it could do without, and writes nothing.\n"
    "Every section of SCENE.prm that is not one of the program's own is a body of that name; below, NAME "
    "stands for "
    "it.\nSection/Key=value may leave out outer sections where only one fits: AFC/C1=... means "
    "slab/AFC/C1=... .\n"
    "Exit codes: 0 done, 2 bad input, 3 computation failed, 130 interrupted.\n";

std::string progress_line(const Simulation& run, double done, double wall) {
  char text[160];
  std::snprintf(text, sizeof text,
                "t %.1f us  step %zu  %.2f M point-steps/s  about %s left  energy error %.2e", run.time * 1e6,
                run.steps, 1e-6 * static_cast<double>(run.point_count() * run.steps) / std::max(wall, 1e-9),
                format_duration(wall * (1 - done) / std::max(done, 1e-9)).c_str(), run.energies.error());
  return text;
}

/// A run under way: the state, what it has left behind, and when the next of it is due.
class Run {
public:
  Run(const SceneInputs& scene_, const RunInputs& inputs_, RunRecord record_,
      const std::filesystem::path& directory_)
      : record(std::move(record_)), scene(scene_), inputs(inputs_), ranks(inputs.solid.ranks),
        simulation(make_simulation(scene_, inputs)),
        answers(inputs.answers, scene, inputs.fragments, record.provenance.input_file), directory(directory_),
        checkpoints(directory, record.provenance, ranks) {
    const std::string& file = record.provenance.input_file;
    check_bodies(simulation, inputs.solid, file);
    check_shots(simulation, scene, answers, file);
  }

  /// Begins anew, or where the newest checkpoint is. @throws InputError before anything is overwritten.
  void begin(bool restart);
  /// Advances to the end, an interruption or a failure, of which it returns the message.
  std::string go();
  ExitCode conclude(const std::string& failure);

  RunRecord record; ///< times up to the begin of this process's steps, until conclude()

private:
  void transfer(Archive& archive);
  /// What fields.h5 says of the scene.
  FrameDescription describe() const;
  /// History and frames that are due.
  void record_step();
  /// Part of the way to the last answer or to the end time, whichever is nearer.
  double part_done() const {
    return std::max(simulation.time / inputs.time.end_time, answers.part_done(simulation));
  }
  /// Memory of the bodies on all ranks, bytes.
  double model_bytes() const;
  /// A checkpoint. One that cannot be written is no reason to stop. @return whether it was written
  bool save();
  /// What this rank asks of all (Simulation::request): to stop, if it has been told to; a checkpoint by the
  /// clock of the first rank.
  static constexpr double nothing = 0, to_save = 1, to_stop = 2;
  double request() const {
    const bool due = ranks.first() && inputs.checkpoint_interval > 0 &&
                     since_checkpoint.seconds() >= inputs.checkpoint_interval;
    return interrupted() ? to_stop : due ? to_save : nothing;
  }
  bool stopped() const { return simulation.request == to_stop; }
  double wall() const { return record.wall + watch.seconds(); }

  const SceneInputs& scene;
  const RunInputs& inputs;
  const Ranks ranks;
  Simulation simulation;
  Answers answers;
  Balancer balancer{inputs.balance};
  std::filesystem::path directory;
  Checkpoints checkpoints;
  std::unique_ptr<History> history;
  std::unique_ptr<Frames> frames;
  double next_frame = 0, next_history = 0; ///< s of simulated time
  Stopwatch watch, since_checkpoint;
};

void Run::begin(bool restart) {
  ranks.on_first([&] { make_output_directory(directory); });
  const bool go_on = restart && checkpoints.find();
  if (!go_on) checkpoints.remove();
  ranks.on_first([&] {
    write_atomically(directory / "resolved.prm", record.provenance.input);
    std::filesystem::remove(directory /
                            "summary.json"); // an older run's answers must not stand beside new fields
    std::printf("penetrate %s: %s, %zu points, spacing %.2f mm, %s\n", version,
                record.provenance.input_file.c_str(), simulation.point_count(),
                simulation.bodies.solid(answers.main_body())->points.spacing.front() * 1e3,
                record.scheme.c_str());
    for (const std::string& warning : simulation.health.warnings)
      std::printf("warning: %s\n", warning.c_str());
    if (ranks.several())
      std::printf("%d ranks, about %zu points each; should one fail, --restart goes on from the last "
                  "checkpoint\n",
                  ranks.count(), simulation.point_count() / static_cast<std::size_t>(ranks.count()));
  });
  frames = std::make_unique<Frames>(directory, simulation, describe(), answers.fragmented(), inputs.fragments,
                                    go_on);
  history = std::make_unique<History>(directory, HistorySubject{answers.moving_body(), answers.main_body()},
                                      go_on, ranks);
  next_frame = inputs.frame_interval;
  if (go_on) {
    checkpoints.load([this](Archive& archive) { transfer(archive); });
    if (ranks.first())
      std::printf("goes on from %s: step %zu, t = %.1f us\n", checkpoints.found().c_str(), simulation.steps,
                  simulation.time * 1e6);
  } else {
    if (restart && ranks.first())
      std::printf("no checkpoint in %s: starts from the beginning\n", directory.c_str());
    history->write(simulation);
    frames->write(simulation);
  }
  std::fflush(stdout); // what is said stays said, however the run ends
  watch = since_checkpoint = Stopwatch();
}

FrameDescription Run::describe() const {
  FrameDescription description = describe_frames(simulation, answers.main_body(), record.provenance);
  for (const BodyInputs& body : scene.bodies)
    if (body.is_rigid())
      if (const std::vector<ContourPoint> contour = outline(body.solid_shape()); !contour.empty()) {
        auto& [name, numbers] = description.outlines.emplace_back(body.name, std::vector<double>{});
        for (const ContourPoint& p : contour) numbers.insert(numbers.end(), {p.z, p.r});
      }
  return description;
}

void Run::transfer(Archive& archive) {
  simulation.transfer(archive);
  answers.transfer(archive);
  history->transfer(archive);
  frames->transfer(archive);
  archive("next_frame", next_frame);
  archive("next_history", next_history);
  double elapsed = wall(), processor = ranks.sum(record.processor + watch.cpu_seconds());
  archive("wall_seconds", elapsed);
  archive("cpu_seconds", processor);
  archive("setup_seconds", record.setup);
  archive("output_seconds", record.output);
  archive("restarts", record.restarts);
  if (!archive.loading()) return;
  record.wall = elapsed, record.processor = ranks.first() ? processor : 0;
  ++record.restarts;
}

void Run::record_step() {
  PhaseTimer timer;
  const TrafficOf use(MpiUse::output);
  if (simulation.time >= next_history) history->write(simulation), next_history += inputs.history_interval;
  if (simulation.time >= next_frame) frames->write(simulation), next_frame += inputs.frame_interval;
  timer.split(record.output);
}

bool Run::save() {
  PhaseTimer timer;
  since_checkpoint = Stopwatch(); // also if it fails: the next one in time
  try {
    checkpoints.write([this](Archive& archive) { transfer(archive); });
  } catch (const ComputationError& error) {
    if (ranks.first())
      std::fprintf(stderr, "penetrate: warning: t = %.1f us: no checkpoint: %s\n", simulation.time * 1e6,
                   error.what());
    return false;
  }
  timer.split(record.output);
  return true;
}

std::string Run::go() {
  Progress progress;
  try {
    while (simulation.time < inputs.time.end_time && !answers.settled(simulation) && !stopped()) {
      simulation.request = request();
      simulation.advance();
      answers.follow(simulation);
      balancer.look(simulation);
      record_step();
      if (const double error = simulation.energies.error(); !(std::abs(error) <= inputs.energy_tolerance))
        throw ComputationError("t = " + std::to_string(simulation.time * 1e6) + " us: the energy error " +
                               std::to_string(error) + " exceeds Run/Energy tolerance");
      if (simulation.request == to_save) save();
      if (ranks.first() && progress.due()) progress.show(progress_line(simulation, part_done(), wall()));
    }
  } catch (const ComputationError& error) {
    return error.what();
  }
  return "";
}

double Run::model_bytes() const {
  double bytes = 0;
  for (const auto& solid : simulation.bodies.solids) bytes += static_cast<double>(solid->memory_bytes());
  return ranks.sum(bytes);
}

ExitCode Run::conclude(const std::string& failure) {
  const TrafficOf use(MpiUse::output);
  const bool stop = failure.empty() && stopped();
  const bool saved = stop && save();
  record.processor = ranks.sum(record.processor + watch.cpu_seconds());
  record.wall = wall();
  record.ranks = ranks.count();
  record.imbalance = balancer.imbalance(), record.rebalances = balancer.rebalances();
  record.model_bytes = model_bytes();
  record.ended = !failure.empty()                         ? "failed: " + failure
                 : stop                                   ? "interrupted"
                 : simulation.time < inputs.time.end_time ? "finished"
                                                          : "end time";
  history->write(simulation);
  frames->write(simulation);
  simulation.look_at_health();
  answers.measure(simulation);
  const Summary summary = summarize(simulation, scene, record, answers);
  ranks.on_first([&] {
    answers.write_tables(directory);
    summary.write(directory / "summary.json");
    print_result(simulation, record, answers);
    std::printf("results in %s\n", directory.c_str());
  });
  if (!failure.empty())
    throw ComputationError(failure + "; everything up to then is in " + directory.string());
  if (!stop) return ExitCode::done;
  if (ranks.first())
    std::fprintf(stderr, "penetrate: interrupted at t = %.1f us, results so far are in %s%s\n",
                 simulation.time * 1e6, directory.c_str(),
                 saved ? "; --restart goes on from here" : "; there is no checkpoint of this state");
  return ExitCode::interrupted;
}

ExitCode run(const CommandLine& line, const Ranks& ranks) {
  if (line.help) {
    if (ranks.first()) std::printf("%s%s", usage, SceneFile().parameters.help().c_str());
    return ExitCode::done;
  }
  if (line.input.empty() || !line.more.empty())
    throw InputError(std::string("one scene file is needed\n") + usage);
  PhaseTimer timer;
  SceneFile file(line.input, line.overrides);
  const SceneInputs& scene = file.scene;
  RunInputs& inputs = file.run;
  std::unique_ptr<tbb::global_control> threads;
  if (inputs.threads == 0 && ranks.several()) inputs.threads = ranks.threads();
  if (inputs.threads > 0)
    threads =
        std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism, inputs.threads);
  if (line.plan) {
    if (ranks.first()) std::printf("%s", make_plan(scene, inputs, line.input).c_str());
    return ExitCode::done;
  }
  inputs.solid.ranks = ranks;
  Run run(scene, inputs,
          {.provenance = make_provenance("penetrate", line.input, file.parameters.resolved()),
           .scheme = name_of(inputs.solid.integration.scheme)},
          line.output);
  run.begin(line.restart);
  timer.split(run.record.setup);
  return run.conclude(run.go());
}

} // namespace
} // namespace spall

int main(int argc, char** argv) {
  const spall::Ranks ranks(argc, argv);
  return spall::run_program(
      "penetrate",
      [&] {
        try {
          return spall::run(spall::parse_command_line(argc, argv), ranks);
        } catch (const spall::InputError&) {
          throw; // all ranks know of it
        } catch (const spall::ComputationError&) {
          throw;
        } catch (const std::exception& error) {
          if (ranks.several()) {
            std::fprintf(stderr, "penetrate: rank %d: %s\n", ranks.rank(), error.what());
            ranks.abort(static_cast<int>(spall::ExitCode::computation_failed));
          }
          throw;
        }
      },
      ranks.first());
}
