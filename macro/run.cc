#include "macro/run.h"

#include "macro/setup/check_bodies.h"
#include "macro/setup/check_shots.h"
#include "macro/setup/make_simulation.h"
#include "shared/input/quantity.h"
#include "shared/input/text_file.h"
#include "shared/output_directory.h"
#include "shared/program.h"
#include "shared/traffic.h"
#include "shared/version.h"

#include <cmath>
#include <cstdio>

namespace spall {
namespace fs = std::filesystem;
namespace {

/// How runs end that have come to their end, and what a summary says whose answers are still to be measured.
const char *const with_answers = "finished", *const at_end_time = "end time",
                  *const unevaluated = "not evaluated";

/// Whether a summary is that of a run that has come to its end, with its answers.
bool is_concluded(const fs::path& summary) {
  if (!fault_of_file(summary).empty()) return false;
  Lines lines(read_text_file(summary));
  for (std::string line; lines.next(line);)
    for (const char* end : {with_answers, at_end_time})
      if (line.find("\"ended\": \"" + std::string(end) + "\"") != std::string::npos) return true;
  return false;
}

} // namespace

std::vector<std::string> Run::files() {
  return {"summary.json",         "summary_previous.json",
          "history.csv",          "fields.h5",
          "fields.xdmf",          "fields",
          "fields/*.h5",          "resolved.prm",
          "checkpoint.h5",        "checkpoint_previous.h5",
          "*fragments.csv",       "*craters.csv",
          "*crater_profiles.csv", "*debris_cone.csv"};
}

Run::Run(const SceneInputs& scene_, const RunInputs& inputs_, RunRecord record_, ResultFolder& folder_)
    : record(std::move(record_)), scene(scene_), inputs(inputs_), ranks(inputs.solid.ranks), folder(folder_),
      simulation(make_simulation(scene_, inputs)),
      answers(inputs.answers, scene, inputs.fragments, record.provenance.input_file),
      checkpoints(folder.path(), record.provenance, record.files, ranks),
      rigid_pairs(simulation.bodies.rigids) {
  const std::string& file = record.provenance.input_file;
  check_bodies(simulation, inputs.solid, file);
  check_shots(simulation, scene, answers, file);
}

void Run::make_files(bool go_on) {
  frames = std::make_unique<Frames>(folder.path(), simulation,
                                    describe_frames(simulation, answers.main_body(), record.provenance),
                                    answers.fragmented(), inputs.fragments, go_on);
  history = std::make_unique<History>(
      folder.path(), HistorySubject{answers.moving_body(), answers.main_body()}, go_on, ranks);
  next_frame = inputs.frame_interval;
}

void Run::announce() {
  ranks.on_first([&] {
    write_atomically(folder.path() / "resolved.prm", record.provenance.input);
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
}

void Run::begin() {
  end_at_once_if_interrupted(false);
  folder.own();
  announce();
  make_files(false);
  write_history();
  frames->write(simulation);
  std::fflush(stdout); // what is said stays said, however the run ends
  watch = since_checkpoint = Stopwatch();
}

bool Run::go_on() {
  if (!checkpoints.find())
    throw InputError("--restart: there is no checkpoint in '" + folder.path().string() + "'");
  make_files(true);
  checkpoints.load([this](Archive& archive) { transfer(archive); });
  const fs::path summary = folder.path() / "summary.json", before = folder.path() / "summary_previous.json";
  if (finished() && ranks.any(ranks.first() && is_concluded(summary))) {
    if (ranks.first())
      std::printf("%s is finished at t = %.1f us, its results are in %s; %s extends it\n",
                  record.provenance.input_file.c_str(), simulation.time * 1e6, folder.path().c_str(),
                  simulation.time >= inputs.time.end_time  ? "a later Time/End time"
                  : inputs.answers.until == Until::settled ? "Run/Until = answered or end time"
                                                           : "Run/Until = end time");
    return false;
  }
  end_at_once_if_interrupted(false);
  announce();
  // Answers of an earlier end must not stand beside newer fields; they are kept until there are others.
  ranks.on_first([&] {
    if (fs::exists(summary)) fs::rename(summary, before);
    std::printf("goes on from %s: step %zu, t = %.1f us\n", checkpoints.found().c_str(), simulation.steps,
                simulation.time * 1e6);
  });
  history->go_on();
  frames->go_on();
  record_step(); // what could not be written before, if that ended the run
  std::fflush(stdout);
  watch = since_checkpoint = Stopwatch();
  return true;
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
  // The next output is due after the present time even if steps are longer than the interval: a restart
  // writes no row twice.
  const auto next_after_now = [this](double interval) {
    return interval * (std::floor(simulation.time / interval) + 1);
  };
  if (simulation.time >= next_history)
    write_history(), next_history = next_after_now(inputs.history_interval);
  if (simulation.time >= next_frame)
    frames->write(simulation), next_frame = next_after_now(inputs.frame_interval);
  timer.split(record.output);
}

void Run::write_history() {
  simulation.measure_stored_energy();
  history->write(simulation);
}

bool Run::save() {
  PhaseTimer timer;
  since_checkpoint = Stopwatch(); // also if it fails: the next one in time
  try {
    checkpoints.write([this](Archive& archive) { transfer(archive); });
  } catch (const OutputError& error) {
    if (ranks.first())
      std::fprintf(stderr, "penetrate: warning: t = %.1f us: no checkpoint: %s\n", simulation.time * 1e6,
                   error.what());
    return false;
  }
  timer.split(record.output);
  return true;
}

double Run::request() const {
  const bool due = ranks.first() && inputs.checkpoint_interval > 0 &&
                   since_checkpoint.seconds() >= inputs.checkpoint_interval;
  return interrupted() ? to_stop : due ? to_save : nothing;
}

std::string Run::progress_line() const {
  const double done = part_done(), elapsed = wall();
  const std::string left = format_duration(elapsed * (1 - done) / std::max(done, 1e-9));
  char text[160];
  // Only what the first rank knows by itself: a deformable body has its points on all ranks.
  if (const RigidBody* body = simulation.bodies.rigid(answers.moving_body()))
    std::snprintf(text, sizeof text,
                  "%3.0f %%  t %.3f ms  velocity %.1f m/s  front at %.1f mm  about %s left", 100 * done,
                  simulation.time * 1e3, body->velocity[2], body->front() * 1e3, left.c_str());
  else
    std::snprintf(text, sizeof text, "%3.0f %%  t %.3f ms  step %zu  energy error %.1e  about %s left",
                  100 * done, simulation.time * 1e3, simulation.steps, simulation.energies.error(),
                  left.c_str());
  return text;
}

void Run::check_energy() const {
  const double error = simulation.energies.error();
  if (!(std::abs(error) <= inputs.energy_tolerance))
    throw ComputationError("t = " + in_six_digits(simulation.time * 1e6) + " us: the energy error " +
                           in_six_digits(error) + " exceeds Run/Energy tolerance");
}

void Run::check_rigid_pairs() {
  if (const auto pair = rigid_pairs.overlapping(simulation.bodies.rigids))
    throw ComputationError("t = " + in_six_digits(simulation.time * 1e6) + " us: the rigid bodies '" +
                           pair->first + "' and '" + pair->second +
                           "' meet, and rigid bodies do not touch each other: make one of them deformable");
}

StepsEnd Run::go() {
  Progress progress;
  try {
    while (!finished() && !stopped()) {
      simulation.request = request();
      simulation.advance();
      answers.follow(simulation);
      balancer.look(simulation);
      record_step();
      check_energy();
      check_rigid_pairs();
      if (simulation.request == to_save) save();
      if (ranks.first() && progress.due()) progress.show(progress_line());
    }
  } catch (const OutputError& error) {
    return {"t = " + in_six_digits(simulation.time * 1e6) + " us: " + error.what(), true};
  } catch (const ComputationError& error) {
    return {error.what(), false};
  } catch (const std::exception& error) {
    if (ranks.several()) throw; // the others do not know of it
    return {error.what(), false};
  }
  return {};
}

double Run::model_bytes() const {
  double bytes = 0;
  for (const auto& solid : simulation.bodies.solids) bytes += static_cast<double>(solid->memory_bytes());
  return ranks.sum(bytes);
}

void Run::keep(StepsEnd& end, const std::function<void()>& write) {
  try {
    write();
  } catch (const OutputError& error) {
    if (end.failure.empty()) end.failure = error.what();
  }
}

void Run::write_summary(bool answered) {
  const Summary summary = summarize(simulation, scene, record, answers, answered);
  ranks.on_first([&] { summary.write(folder.path() / "summary.json"); });
}

ExitCode Run::conclude(StepsEnd end) {
  const TrafficOf use(MpiUse::output);
  const bool stop = end.failure.empty() && stopped();
  const bool saved = end.sound && save();
  record.processor = ranks.sum(record.processor + watch.cpu_seconds());
  record.wall = wall();
  record.ranks = ranks.count();
  record.imbalance = balancer.imbalance(), record.rebalances = balancer.rebalances();
  record.model_bytes = model_bytes();
  keep(end, [&] { write_history(); });
  keep(end, [&] { frames->write(simulation); });
  record.ended = unevaluated;
  keep(end, [&] { write_summary(false); });
  evaluate(
      "alternating fields", [&] { simulation.look_at_health(); }, record.warnings, ranks);
  answers.measure(simulation, record.warnings);
  keep(end, [&] { ranks.on_first([&] { answers.write_tables(folder.path()); }); });
  record.ended = !end.failure.empty()                     ? "failed: " + end.failure
                 : stop                                   ? "interrupted"
                 : simulation.time < inputs.time.end_time ? with_answers
                                                          : at_end_time;
  keep(end, [&] {
    write_summary(true);
    ranks.on_first([&] { fs::remove(folder.path() / "summary_previous.json"); });
  });
  ranks.on_first([&] {
    print_result(simulation, record, answers);
    std::printf("results in %s\n", folder.path().c_str());
  });
  if (!end.failure.empty())
    throw ComputationError(end.failure + "; everything up to then is in " + folder.path().string());
  if (!stop) return ExitCode::done;
  if (ranks.first())
    std::fprintf(stderr, "penetrate: interrupted at t = %.1f us, results so far are in %s%s\n",
                 simulation.time * 1e6, folder.path().c_str(),
                 saved ? "; --restart goes on from here" : "; there is no checkpoint of this state");
  return ExitCode::interrupted;
}

} // namespace spall
