// The program microcell makes a damage table: it strains cracked cells of concrete of several sizes until
// they fail and writes their homogenised response, which the macroscopic model reads.

#include "micro/ensemble/ensemble.h"
#include "micro/ensemble/samples.h"
#include "micro/inputs.h"
#include "micro/single_cell.h"
#include "shared/command_line.h"
#include "shared/output_directory.h"
#include "shared/program.h"
#include "shared/provenance.h"
#include "shared/result_folder.h"
#include "shared/version.h"

#include <deal.II/base/multithread_info.h>

#include <cstdio>

namespace {

using namespace spall;
namespace fs = std::filesystem;

void print_help(const Parameters& parameters, const std::string& topic) {
  const std::string keys = parameters.help(topic);
  if (!topic.empty()) {
    std::printf("%s", keys.c_str());
    return;
  }
  std::printf(
      "microcell CASE.prm [--output DIR] [--restart | --force] [--check] [Section/Key=value ...]\n"
      "microcell --help [SECTION | KEY]\n"
      "microcell --version\n\n"
      "Pulls a square cell of concrete with a crack apart, for each cell size, and writes into DIR "
      "(default: out/CASE)\n"
      "  damage_table.h5, .csv  damage against strain for each size: the input of penetrate\n"
      "  curve.csv              the curve of the reference size in full\n"
      "  fields.pvd             displacement and stress of the reference cell at rows of curve.csv, for "
      "ParaView\n"
      "  path.csv               strains, stresses, control and stability of every row of that curve\n"
      "  summary.json           what was computed, how fast, and how well energy is balanced\n"
      "  resolved.prm           every key with the value that was used: an input that repeats the run\n"
      "With Ensemble/Samples > 0: many random cells instead, in samples/, and damage_table.h5 (mean),\n"
      "damage_table_weak.h5, damage_table_strong.h5 (band). --restart goes on where a run of the same case\n"
      "ended: samples that are there are kept; more Ensemble/Samples extend an ensemble.\n"
      "Results that are in DIR already are not replaced, unless --force is given. A run owns DIR until it "
      "ends.\n"
      "mpirun -n N microcell ... shares the samples of an ensemble out; as root it needs\n"
      "export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 first.\n"
      "--check reads the case and says what is wrong with it; it computes and writes nothing.\n"
      "Exit codes: 0 done, 2 bad input and nothing on the disk was changed, 3 computation failed or "
      "something could not be written, 130 interrupted.\n\n"
      "Every key of CASE.prm:\n%s",
      keys.c_str());
}

/// Whether there is something to compute with --restart: a case that is finished says so.
/// @throws InputError if the folder does not hold this case
bool go_on(const MicrocellInputs& inputs, const Provenance& provenance, const fs::path& output,
           const Ranks& ranks) {
  bool finished = false;
  ranks.on_first([&] {
    const bool same = inputs.ensemble.samples > 0 ? has_samples(inputs, provenance, output / "samples")
                                                  : holds_input(provenance, output);
    if (!same)
      throw InputError("--restart: '" + output.string() + "' holds no results of this case to go on from");
    finished = is_finished(inputs, provenance, output);
    if (finished)
      std::printf("%s is finished, its results are in %s\n", provenance.input_file.c_str(), output.c_str());
  });
  return !ranks.any(finished);
}

ExitCode run(int argc, char** argv, const Ranks& ranks) {
  const CommandLine line = parse_command_line(argc, argv, {.restart = true, .force = true});
  MicrocellInputs inputs;
  Parameters parameters;
  inputs.declare(parameters);
  if (line.help) {
    print_help(parameters, line.topic);
    return ExitCode::done;
  }
  if (line.version) {
    std::printf("microcell %s\n", version);
    return ExitCode::done;
  }
  if (line.input.empty()) throw InputError("no case file given; usage: microcell CASE.prm, see --help");
  if (!line.more.empty()) throw InputError("one case file only, found also '" + line.more.front() + "'");
  parameters.read(line.input, line.overrides);
  check(inputs, line.input);
  if (line.check) {
    if (!ranks.first()) return ExitCode::done;
    print_warnings("microcell", parameters.warnings());
    print_sound(line.input);
    return ExitCode::done;
  }
  const fs::path output = output_folder(line);
  const Existing existing = line.restart ? Existing::go_on
                            : line.force ? Existing::replace
                                         : Existing::refuse;
  ResultFolder folder(output,
                      {"summary.json", "resolved.prm", "damage_table*.h5", "damage_table*.csv", "curve*.csv",
                       "path.csv", "fields*.vtu", "fields.pvd", "samples", "samples/sample_*.h5"},
                      existing, ranks);
  folder.check(parameters.files());

  // The linear systems are too small to gain from several threads.
  dealii::MultithreadInfo::set_thread_limit(1);
  const Provenance provenance = make_provenance("microcell", line.input, parameters.resolved());
  if (line.restart && !go_on(inputs, provenance, output, ranks)) return ExitCode::done;
  folder.own();
  if (ranks.first()) print_warnings("microcell", parameters.warnings());
  if (inputs.ensemble.samples > 0) return run_ensemble(inputs, ranks, provenance, output, line.restart);
  if (!ranks.first()) return ExitCode::done;
  write_atomically(output / "resolved.prm", provenance.input);
  if (ranks.count() > 1)
    std::printf("  note: a single cell is computed by the first of the %d ranks alone; ensembles use all\n",
                ranks.count());
  return run_single_cell(inputs, provenance, output);
}

} // namespace

int main(int argc, char** argv) {
  spall::hold_standard_streams();
  const spall::Ranks ranks(argc, argv);
  return spall::run_program("microcell", [&] {
    try {
      return run(argc, argv, ranks);
    } catch (const spall::InputError&) { // all ranks find the error, the first one prints it
      if (ranks.first()) throw;
      return spall::ExitCode::bad_input;
    }
  });
}
