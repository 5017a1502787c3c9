// The program microcell makes a damage table: it strains cracked cells of concrete of several sizes until
// they fail and writes their homogenised response, which the macroscopic model reads.

#include "micro/ensemble/ensemble.h"
#include "micro/inputs.h"
#include "micro/single_cell.h"
#include "shared/output_directory.h"
#include "shared/program.h"
#include "shared/provenance.h"

#include <deal.II/base/multithread_info.h>

#include <cstdio>

namespace {

using namespace spall;
namespace fs = std::filesystem;

void print_help(const Parameters& parameters) {
  std::printf(
      "microcell CASE.prm [--output DIR] [Section/Key=value ...]\n\n"
      "Pulls a square cell of concrete with a crack apart, for each cell size, and writes into DIR "
      "(default: out)\n"
      "  damage_table.h5, .csv  damage against strain for each size: the input of penetrate\n"
      "  curve.csv              the curve of the reference size in full\n"
      "  fields.pvd             displacement and stress of the reference cell, for ParaView\n"
      "  path.csv               strains, stresses, control and stability of every row of that curve\n"
      "  summary.json           what was computed, how fast, and how well energy is balanced\n"
      "With Ensemble/Samples > 0: many random cells instead, in samples/, and damage_table.h5 (mean),\n"
      "damage_table_weak.h5, damage_table_strong.h5 (band); --restart continues an interrupted run.\n\n"
      "Every key of CASE.prm:\n%s",
      parameters.help().c_str());
}

ExitCode run(int argc, char** argv, const Ranks& ranks) {
  const CommandLine line = parse_command_line(argc, argv);
  MicrocellInputs inputs;
  Parameters parameters;
  inputs.declare(parameters);
  if (line.help) {
    print_help(parameters);
    return ExitCode::done;
  }
  if (line.input.empty()) throw InputError("no case file given; usage: microcell CASE.prm, see --help");
  if (!line.more.empty()) throw InputError("one case file only, found also '" + line.more.front() + "'");
  parameters.read(line.input, line.overrides);
  if (line.plan) throw InputError("--plan: a microcell takes seconds; only penetrate plans");
  if (line.restart && inputs.ensemble.samples == 0)
    throw InputError("--restart: a single microcell takes seconds and has no checkpoint; ensembles have");
  check(inputs, line.input);
  const fs::path output = line.output;
  make_output_directory(output);

  // The linear systems are too small to gain from several threads.
  dealii::MultithreadInfo::set_thread_limit(1);
  const Provenance provenance = make_provenance("microcell", line.input, parameters.resolved());
  if (inputs.ensemble.samples > 0) return run_ensemble(inputs, ranks, provenance, output, line.restart);
  if (!ranks.first()) return ExitCode::done;
  if (ranks.count() > 1)
    std::printf("  note: a single cell is computed by the first of the %d ranks alone; ensembles use all\n",
                ranks.count());
  return run_single_cell(inputs, provenance, output);
}

} // namespace

int main(int argc, char** argv) {
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
