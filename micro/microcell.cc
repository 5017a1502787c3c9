// From cracks in a cell of concrete to a damage table: pulls cracked cells of several sizes apart and writes
// what they answer, for the macroscopic model to use.

#include "micro/ensemble/ensemble.h"
#include "micro/ensemble/samples.h"
#include "micro/inputs.h"
#include "micro/loading/undamaged_energy.h"
#include "micro/output/curve_file.h"
#include "micro/output/energy_report.h"
#include "micro/output/fields.h"
#include "micro/output/path_file.h"
#include "micro/solid.h"
#include "shared/damage_table.h"
#include "shared/output_directory.h"
#include "shared/program.h"
#include "shared/progress.h"
#include "shared/provenance.h"
#include "shared/summary.h"
#include "shared/version.h"

#include <deal.II/base/multithread_info.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

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
      "damage_table_weak.h5, damage_table_strong.h5 (band); --restart goes on where a run ended.\n\n"
      "Every key of CASE.prm:\n%s",
      parameters.help().c_str());
}

/// Traces one size under a progress line.
template<int dim>
CurveTrace<dim> trace_with_progress(const InterfaceProblem<dim>& problem, const SteppingSettings& stepping) {
  Progress progress;
  return trace_curve(problem, stepping, [&](const DamageCurve& curve) {
    if (progress.due()) {
      char text[120];
      std::snprintf(text, sizeof text, "cell of %g mm: strain %.3g, damage %.3f", problem.cell_size * 1e3,
                    curve.strain.back(), curve.damage.back());
      progress.show(text);
    }
    return !interrupted();
  });
}

/// Totals over all sizes.
struct Effort {
  int steps = 0, newton_iterations = 0, cut_steps = 0;
  double tracing_seconds = 0;
  template<int dim> void add(const CurveTrace<dim>& trace, double seconds) {
    steps += static_cast<int>(trace.curve.strain.size()) - 1;
    newton_iterations += trace.newton_iterations;
    cut_steps += trace.cut_steps;
    tracing_seconds += seconds;
  }
};

/// What the curve of the reference size says, for summary.json.
template<int dim>
void summarise(Summary& summary, const CurveTrace<dim>& trace, const InterfaceProblem<dim>& problem) {
  const DamageCurve& curve = trace.curve;
  const auto peak = std::max_element(curve.stress.begin(), curve.stress.end());
  summary.set("cell_size", curve.cell_size);
  summary.set("initial_damage", curve.damage.front());
  summary.set("final_damage", curve.damage.back());
  summary.set("peak_stress", *peak);
  summary.set("strain_at_peak", curve.strain[peak - curve.stress.begin()]);
  summary.set("final_strain", curve.strain.back());
  summary.set("work", curve.work.back());
  summary.set("dissipation", curve.dissipation.back());
  // One line across the cell: G_f times the length of its ligament. Of several lines only one need fail.
  double ligament = 0;
  int lines = 0;
  for (const CrackNode& node : problem.cell.nodes) {
    if (!node.initially_open) ligament += node.weight;
    lines = std::max(lines, node.line + 1);
  }
  if (lines == 1)
    summary.set("work_to_failure_expected",
                problem.law.work(problem.law.final_opening()) * ligament / curve.cell_size);
  double lowest = std::numeric_limits<double>::infinity();
  int negative = 0, prescribed = 0, branches = 0, snaps = 0, passed = 0;
  for (const RowReport& row : trace.reports) {
    if (!std::isnan(row.stability.lowest)) lowest = std::min(lowest, row.stability.lowest);
    negative = std::max(negative, row.stability.negative);
    prescribed += row.control == Control::damage;
  }
  // Where the tangent is not symmetric: rows whose stability neither test settles.
  int open = 0;
  for (const RowReport& row : trace.reports) open += row.stability.lowest < 0 && row.stability.negative == 0;
  for (const CurveEvent& event : trace.events)
    ++(event.kind == CurveEvent::Kind::bifurcation ? branches
       : event.kind == CurveEvent::Kind::snap_back ? snaps
                                                   : passed);
  summary.set("lowest_eigenvalue", lowest);
  summary.set("most_negative_eigenvalues", negative);
  summary.set("rows_under_damage_control", prescribed);
  summary.set("rows_of_open_stability", open);
  summary.set("bifurcations", branches);
  summary.set("branches_passed", passed);
  summary.set("snap_backs", snaps);
}

/// Where the cracks ran: lengths of fully broken crack, m, that would have dissipated the same energy.
template<int dim>
void summarise_paths(Summary& summary, const InterfaceProblem<dim>& problem, const CellState<dim>& state,
                     std::size_t aggregates) {
  double zone = 0, mortar = 0;
  for (std::size_t i = 0; i < problem.cell.nodes.size(); ++i) {
    const CohesiveLaw& law = problem.law_at(i);
    const double length = problem.cell.nodes[i].weight * problem.cell_size *
                          law.dissipation(state.largest[i]) / law.dissipation(law.final_opening());
    (problem.cell.nodes[i].line < static_cast<int>(aggregates) ? zone : mortar) += length;
  }
  summary.set("aggregates", aggregates);
  summary.set("crack_length_interface_zone", zone);
  summary.set("crack_length_mortar", mortar);
}

/// Limits and branches are never passed in silence.
template<int dim> void print_events(const CurveTrace<dim>& trace) {
  int snaps = 0;
  double deepest = 0, from = 0, to = 0;
  for (const CurveEvent& event : trace.events) {
    if (event.kind == CurveEvent::Kind::bifurcation) {
      std::printf("    the path branches at strain %.4g; the branch of lower energy was followed\n",
                  event.from);
      continue;
    }
    if (event.kind == CurveEvent::Kind::branch_passed) {
      std::printf(
          "    caution: symmetric path kept: paths of lower energy leave this one between strains %.4g "
          "and %.4g, for instance with only one of several equal crack tips growing, and none was found\n",
          event.from, event.to);
      continue;
    }
    ++snaps;
    if (event.from - event.to < deepest) continue;
    deepest = event.from - event.to;
    from = event.from;
    to = event.to;
  }
  if (snaps > 0)
    std::printf("    %d snap-back(s), the largest from strain %.4g back to %.4g: followed by prescribing the "
                "damage; the table holds the envelope\n",
                snaps, from, to);
}

void print_curve(const DamageCurve& curve, double seconds) {
  const auto peak = std::max_element(curve.stress.begin(), curve.stress.end());
  std::printf("  cell of %8.5g mm: peak %.3f MPa at strain %.3e, damage %.3f to %.3f, %zu rows, %.0f ms\n",
              curve.cell_size * 1e3, *peak / 1e6, curve.strain[peak - curve.stress.begin()],
              curve.damage.front(), curve.damage.back(), curve.strain.size(), seconds * 1e3);
}

void common(Summary& summary, const CommandLine& line) {
  summary.set("program", std::string("microcell"));
  summary.set("version", version);
  summary.set("input_file", line.input);
}

/// One cell, all its sizes.
template<int dim>
ExitCode run_cell(const MicrocellInputs& inputs, const Provenance& provenance, const CommandLine& line) {
  const Stopwatch stopwatch;
  const fs::path output = line.output;
  Summary summary;
  common(summary, line);
  std::printf("%s: %s\n", provenance.program.c_str(), line.input.c_str());
  Solid<dim> solid = make_solid<dim>(inputs, inputs.reference_size);
  const double condensation_seconds = stopwatch.seconds();
  const auto law = make_cohesive_law(inputs.softening, inputs.strength, inputs.fracture_energy);
  const std::size_t dofs = solid.bulk->dofs().n_dofs(),
                    condensed_unknowns = solid.bulk->condensed().stiffness.rows();
  std::printf("  solid: %zu unknowns condensed onto %zu openings of its cracks in %.0f ms\n", dofs,
              condensed_unknowns, condensation_seconds * 1e3);
  const MacroLoad<dim> load = inputs.load<dim>();
  if (inputs.aggregates.present()) {
    std::printf("  %zu aggregates; uncracked: E = %.1f MPa, nu = %.4f, anisotropy %.1f %%\n",
                aggregate_diameters(inputs.aggregates.grading, inputs.reference_size).size(),
                solid.youngs_modulus / 1e6, solid.poisson_ratio, 100 * solid.anisotropy);
    summary.set("youngs_modulus", solid.youngs_modulus);
    summary.set("poisson_ratio", solid.poisson_ratio);
    summary.set("anisotropy", solid.anisotropy);
  }
  if (inputs.boundary == Boundary::linear_displacement) {
    const char* caution =
        "the edge of the cell follows the macroscopic strain, so that no crack can cross it: "
        "damage stays below 1. Use Cell/Boundary = periodic for a table";
    std::printf("  caution: %s\n", caution);
    summary.set("caution", caution);
  }
  std::fflush(stdout);

  DamageTable table = describe_table(inputs, provenance);
  table.youngs_modulus = solid.youngs_modulus;
  table.poisson_ratio = solid.poisson_ratio;
  table.curves.resize(inputs.sizes.size());
  Effort effort;
  EnergyChecks checks;
  const auto finish = [&](bool complete, const std::string& reason) {
    summary.set("dofs", dofs);
    summary.set("condensed_unknowns", condensed_unknowns);
    summary.set("steps", effort.steps);
    summary.set("newton_iterations", effort.newton_iterations);
    summary.set("cut_steps", effort.cut_steps);
    summary.set("wall_seconds", stopwatch.seconds());
    summary.set("cpu_seconds", stopwatch.cpu_seconds());
    summary.set("condensation_seconds", condensation_seconds);
    summary.set("seconds_per_load_step", effort.tracing_seconds / std::max(1, effort.steps));
    summary.set("peak_memory_bytes", peak_memory_bytes());
    summary.set("ranks", 1);
    summary.set("threads", 1);
    report_energies(checks, inputs.mode.friction > 0, summary);
    summary.set("complete", complete);
    if (!complete) summary.set("reason", reason);
    summary.write(output / "summary.json");
  };

  // The reference size first: its results are there even if a larger size fails.
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < inputs.sizes.size(); ++i)
    order.insert(inputs.sizes[i] == inputs.reference_size ? order.begin() : order.end(), i);
  for (const std::size_t i : order) {
    const bool reference = i == order.front();
    if (!reference && inputs.aggregates.present()) solid = make_solid<dim>(inputs, inputs.sizes[i]);
    const Bulk<dim>& bulk = *solid.bulk;
    const CondensedCell<dim> cell = release(bulk.condensed(), load.free);
    const auto line_laws = inputs.line_laws(inputs.sizes[i]);
    const SplitEnergy undamaged =
        undamaged_energy(bulk.condensed(), load, solid.youngs_modulus, solid.poisson_ratio);
    InterfaceProblem<dim> problem{.cell = cell,
                                  .law = *law,
                                  .youngs_modulus = inputs.youngs_modulus,
                                  .cell_size = inputs.sizes[i],
                                  .newton = inputs.newton,
                                  .direction = load.direction,
                                  .mode = inputs.mode};
    for (const auto& line_law : line_laws) problem.line_laws.push_back(line_law.get());
    const Stopwatch tracing;
    CurveTrace<dim> trace = trace_with_progress(problem, inputs.stepping);
    const double seconds = tracing.seconds();
    set_damage_plus(trace.curve, undamaged);
    effort.add(trace, seconds);
    checks.include(trace.curve);
    const std::string reason = trace.interrupted ? "interrupted" : trace.failure;
    if (reference) {
      write_curve(trace.curve, reason, output / "curve.csv");
      write_path(problem, bulk.condensed(), load, trace, output / "path.csv");
      summarise(summary, trace, problem);
      if (inputs.aggregates.present())
        summarise_paths(summary, problem, trace.states.back(),
                        aggregate_diameters(inputs.aggregates.grading, problem.cell_size).size());
      std::vector<CellState<dim>> states = trace.states;
      for (CellState<dim>& state : states)
        state.strain =
            complete_strain(bulk.condensed(), load.free, state.strain, state.opening / problem.cell_size);
      write_fields(bulk, problem, states, rows_to_show(trace.curve, inputs.field_states), output);
    } else if (!trace.complete()) {
      char name[64];
      std::snprintf(name, sizeof name, "curve_%gmm.csv", problem.cell_size * 1e3);
      write_curve(trace.curve, reason, output / name);
    }
    if (!trace.complete()) {
      finish(false, reason);
      if (trace.interrupted) return ExitCode::interrupted;
      throw ComputationError(reason + " (rows so far are kept in '" + output.string() +
                             "'; no damage table was written)");
    }
    print_curve(trace.curve, seconds);
    print_events(trace);
    table.curves[i] = envelope(trace.curve);
  }

  write_damage_table(table, output / "damage_table.h5");
  write_damage_csv(table, output / "damage_table.csv");
  finish(true, "");
  if (const double last = table.curves.front().damage.back(); last < 0.999)
    std::printf("  note: the table ends at damage %.3f\n", last);
  std::printf("  results in %s (damage_table.h5, curve.csv, fields.pvd, summary.json), %s\n",
              output.string().c_str(), format_duration(stopwatch.seconds()).c_str());
  return ExitCode::done;
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

  // The problem is too small for threads to pay.
  dealii::MultithreadInfo::set_thread_limit(1);
  const Provenance provenance = make_provenance("microcell", line.input, parameters.resolved());
  if (inputs.ensemble.samples > 0) return run_ensemble(inputs, ranks, provenance, output, line.restart);
  if (!ranks.first()) return ExitCode::done;
  if (ranks.count() > 1)
    std::printf("  note: a single cell is computed by the first of the %d ranks alone; ensembles use all\n",
                ranks.count());
  return inputs.dimension == 3 ? run_cell<3>(inputs, provenance, line)
                               : run_cell<2>(inputs, provenance, line);
}

} // namespace

int main(int argc, char** argv) {
  const spall::Ranks ranks(argc, argv);
  return spall::run_program("microcell", [&] {
    try {
      return run(argc, argv, ranks);
    } catch (const spall::InputError&) { // all ranks find it, one says so
      if (ranks.first()) throw;
      return spall::ExitCode::bad_input;
    }
  });
}
