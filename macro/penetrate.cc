// Shoots a scene: reads SCENE.prm, advances it explicitly, writes history, fields and summary.

#include "macro/run.h"
#include "macro/setup/alternatives.h"
#include "macro/setup/check_bodies.h"
#include "macro/setup/check_schemes.h"
#include "macro/setup/check_shots.h"
#include "macro/setup/check_size.h"
#include "macro/setup/make_simulation.h"
#include "macro/setup/plan.h"
#include "macro/setup/scene_file.h"
#include "shared/command_line.h"
#include "shared/program.h"
#include "shared/version.h"

#include <tbb/global_control.h>

#include <cstdio>

namespace spall {
namespace {

const char* const usage =
    "usage: penetrate SCENE.prm [--output DIR] [--restart | --force] [--accuracy P%] [--plan | --check] "
    "[Section/Key=value ...]\n"
    "       penetrate --help [SECTION | KEY]   (for example --help AFC, --help \"Time/End time\")\n"
    "       penetrate --version\n"
    "Writes history.csv, fields.h5, fields.xdmf (ParaView) and the folder fields, "
    "summary.json, resolved.prm and checkpoint.h5 into DIR (default: out/SCENE).\n"
    "Results that are in DIR already are not replaced, unless --force is given. A run owns DIR until it "
    "ends.\n"
    "--restart goes on in DIR from its newest checkpoint, with the same input; sections "
    "Output and Run and the end time may differ: a later Time/End time extends a run that is finished.\n"
    "--accuracy 20% replaces symmetry, spacing and scheme of the scene by the cheapest ones whose numerical "
    "error has been measured to be 20 % or less (Run/Accuracy), and says which.\n"
    "--plan says what the scene will cost, and what it could do without, and writes nothing.\n"
    "--check reads the scene, makes its points and says what is wrong with it; it computes and writes "
    "nothing.\n"
    "Every section of SCENE.prm that is not one of the program's own is a body of that name; below, NAME "
    "stands for "
    "it.\nSection/Key=value may leave out outer sections where only one fits: AFC/C1=... means "
    "slab/AFC/C1=... .\n"
    "mpirun -n N penetrate ... uses N processes; as root it needs "
    "export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 first.\n"
    "Exit codes: 0 done, 2 bad input and nothing on the disk was changed, 3 computation failed or something "
    "could not be written, 130 interrupted.\n";

/// Returns a table of the models whose errors have been measured, or nothing for a scene that has none.
std::string other_models(std::vector<Alternative> models, const CommandLine& line) {
  if (models.empty()) try {
      models = alternatives(line.input, line.overrides);
    } catch (const InputError&) {
      return "";
    }
  return table_of(models);
}

/// Makes the checks that a run makes before its first step. @throws InputError
ExitCode check(const SceneFile& file, RunInputs inputs, const CommandLine& line, const Ranks& ranks) {
  inputs.solid.ranks = ranks;
  Simulation simulation = make_simulation(file.scene, inputs);
  const Answers answers(inputs.answers, file.scene, inputs.fragments, line.input);
  check_bodies(simulation, inputs.solid, line.input);
  check_shots(simulation, file.scene, answers, line.input);
  if (!ranks.first()) return ExitCode::done;
  print_warnings("penetrate", file.parameters.warnings());
  print_warnings("penetrate", simulation.health.warnings);
  print_sound(line.input);
  return ExitCode::done;
}

ExitCode run(const CommandLine& line, const Ranks& ranks) {
  if (line.help) {
    const std::string keys = SceneFile().help(line.topic);
    if (ranks.first()) std::printf("%s%s", line.topic.empty() ? usage : "", keys.c_str());
    return ExitCode::done;
  }
  if (line.version) {
    if (ranks.first()) std::printf("penetrate %s\n", version);
    return ExitCode::done;
  }
  if (line.input.empty()) throw InputError("a scene file is needed: penetrate SCENE.prm, see --help");
  if (!line.more.empty())
    throw InputError("one scene file only, found '" + line.input + "' and '" + line.more.front() + "'");
  PhaseTimer timer;
  end_at_once_if_interrupted(true); // until Run begins to write
  std::vector<std::string> overrides = line.overrides;
  std::vector<Alternative> models;
  if (const double percent = SceneFile(line.input, overrides).run.accuracy; percent > 0) {
    models = alternatives(line.input, overrides);
    const Alternative& chosen = cheapest(models, percent / 100, line.input);
    overrides.insert(overrides.end(), chosen.keys.begin(), chosen.keys.end());
    if (ranks.first()) std::printf("%s", in_words(chosen, percent / 100).c_str());
  }
  SceneFile file(line.input, overrides);
  const SceneInputs& scene = file.scene;
  RunInputs& inputs = file.run;
  check_schemes(scene, inputs, line.input);
  ranks.on_all([&] { check_size(scene, ranks, line.input); });
  std::unique_ptr<tbb::global_control> threads;
  if (inputs.threads == 0 && ranks.several()) inputs.threads = ranks.threads();
  if (inputs.threads > 0)
    threads =
        std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism, inputs.threads);
  if (line.check) return check(file, inputs, line, ranks);
  if (line.plan) {
    if (!ranks.first()) return ExitCode::done;
    const std::string plan = make_plan(scene, inputs, line.input) + other_models(models, line);
    print_warnings("penetrate", file.parameters.warnings());
    std::printf("%s", plan.c_str());
    return ExitCode::done;
  }
  inputs.solid.ranks = ranks;
  const Existing existing = line.restart ? Existing::go_on
                            : line.force ? Existing::replace
                                         : Existing::refuse;
  ResultFolder folder(output_folder(line), Run::files(), existing, ranks);
  folder.check(file.parameters.files());
  Run run(scene, inputs,
          {.provenance = make_provenance("penetrate", line.input, file.parameters.resolved()),
           .files = file.parameters.named_files(),
           .scheme = name_of(inputs.solid.integration.scheme)},
          folder);
  if (line.restart && !run.go_on()) return ExitCode::done;
  if (!line.restart) run.begin();
  if (ranks.first()) print_warnings("penetrate", file.parameters.warnings());
  timer.split(run.record.setup);
  return run.conclude(run.go());
}

} // namespace
} // namespace spall

int main(int argc, char** argv) {
  spall::hold_standard_streams();
  const spall::Ranks ranks(argc, argv);
  return spall::run_program(
      "penetrate",
      [&] {
        try {
          return spall::run(spall::parse_command_line(
                                argc, argv, {.restart = true, .force = true, .plan = true, .accuracy = true}),
                            ranks);
        } catch (const spall::InputError&) {
          throw; // all ranks know of it
        } catch (const spall::ComputationError&) {
          throw;
        } catch (const std::exception& error) {
          if (ranks.several()) {
            spall::print_error("penetrate", "rank " + std::to_string(ranks.rank()) + ": " + error.what());
            ranks.abort(static_cast<int>(spall::ExitCode::computation_failed));
          }
          throw;
        }
      },
      ranks.first());
}
