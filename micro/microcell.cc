// From cracks in a cell of concrete to a damage table: pulls cracked cells of several sizes apart and writes
// what they answer, for the macroscopic model to use.

#include "micro/ensemble/band.h"
#include "micro/ensemble/samples.h"
#include "micro/equilibrium/bulk.h"
#include "micro/inputs.h"
#include "micro/output/curve_file.h"
#include "micro/output/fields.h"
#include "micro/output/path_file.h"
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

const std::string program = std::string("microcell ") + version;

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
  const EnergyChecks checks = check_energies(curve);
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
  summary.set("energy_balance_error", checks.work);
  summary.set("psi_against_stress_error", checks.stress);
  double lowest = std::numeric_limits<double>::infinity();
  int negative = 0, prescribed = 0, branches = 0, snaps = 0;
  for (const RowReport& row : trace.reports) {
    if (!std::isnan(row.stability.lowest)) lowest = std::min(lowest, row.stability.lowest);
    negative = std::max(negative, row.stability.negative);
    prescribed += row.control == Control::damage;
  }
  for (const CurveEvent& event : trace.events)
    ++(event.kind == CurveEvent::Kind::bifurcation ? branches : snaps);
  summary.set("lowest_eigenvalue", lowest);
  summary.set("most_negative_eigenvalues", negative);
  summary.set("rows_under_damage_control", prescribed);
  summary.set("bifurcations", branches);
  summary.set("snap_backs", snaps);
}

/// Limits and branches are never passed in silence.
template<int dim> void print_events(const CurveTrace<dim>& trace) {
  int snaps = 0;
  double deepest = 0, from = 0, to = 0;
  for (const CurveEvent& event : trace.events) {
    if (event.kind == CurveEvent::Kind::bifurcation) {
      std::printf("    the path branches at strain %.4g; the stable branch was followed\n", event.from);
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
  int negative = 0;
  for (const RowReport& row : trace.reports) negative = std::max(negative, row.stability.negative);
  if (negative > 1)
    std::printf(
        "    caution: up to %d negative eigenvalues of the tangent (path.csv): a path of lower energy leaves "
        "this one, for instance with only one of several equal crack tips growing\n",
        negative);
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

/// Many random cells: tables of the mean and of the band.
ExitCode run_ensemble(const MicrocellInputs& inputs, const CommandLine& line, const Provenance& provenance) {
  const Stopwatch stopwatch;
  const fs::path output = line.output, folder = output / "samples";
  make_output_directory(folder);
  std::printf("%s: %s, %d samples\n", program.c_str(), line.input.c_str(), inputs.ensemble.samples);
  const SampleReport report = compute_samples(inputs, provenance, folder, line.restart);
  std::vector<DamageTable> samples;
  for (int i = 0; i < inputs.ensemble.samples; ++i)
    if (const fs::path file = sample_file(folder, i); fs::exists(file) && !report.interrupted)
      samples.push_back(read_damage_table(file));

  Summary summary;
  common(summary, line);
  summary.set("samples", inputs.ensemble.samples);
  summary.set("samples_computed", report.computed);
  summary.set("samples_reused", report.reused);
  summary.set("samples_failed", report.failures.size());
  summary.set("wall_seconds", stopwatch.seconds());
  summary.set("cpu_seconds", stopwatch.cpu_seconds());
  summary.set("seconds_per_sample", stopwatch.seconds() / std::max(1, report.computed));
  summary.set("peak_memory_bytes", peak_memory_bytes());
  summary.set("ranks", 1);
  summary.set("threads", inputs.ensemble.threads);
  summary.set("complete", !report.interrupted);
  for (const std::string& failure : report.failures) std::printf("  failed: %s\n", failure.c_str());
  if (report.interrupted) {
    summary.set("reason", "interrupted");
    summary.write(output / "summary.json");
    std::printf("  interrupted; %d samples are kept, --restart goes on\n", report.computed + report.reused);
    return ExitCode::interrupted;
  }
  // A band without the samples that would not compute would be biased.
  constexpr double tolerated = 0.1;
  if (static_cast<double>(report.failures.size()) > tolerated * inputs.ensemble.samples) {
    summary.set("complete", false);
    summary.set("reason", report.failures.front());
    summary.write(output / "summary.json");
    throw ComputationError(std::to_string(report.failures.size()) + " of " +
                           std::to_string(inputs.ensemble.samples) + " samples failed, first " +
                           report.failures.front());
  }

  DamageTable mean = describe_table(inputs, provenance), weak = mean, strong = mean;
  // The modulus of the loading is the same in all samples: energy of the uncracked cell per strain squared.
  const DamageCurve& any = samples.front().curves.front();
  const double modulus = 2 * any.psi_undamaged.back() / (any.strain.back() * any.strain.back());
  for (std::size_t size = 0; size < inputs.sizes.size(); ++size) {
    std::vector<const DamageCurve*> curves;
    for (const DamageTable& sample : samples) curves.push_back(&sample.curves[size]);
    Band band =
        make_band(curves, modulus, inputs.ensemble.band, inputs.stepping.growth, inputs.strength / modulus);
    const auto peak = [](const DamageCurve& curve) {
      return *std::max_element(curve.stress.begin(), curve.stress.end());
    };
    std::printf(
        "  cells of %8.5g mm: peak %.3f MPa (band %.3f to %.3f), initial damage %.3f (%.3f to %.3f)\n",
        inputs.sizes[size] * 1e3, peak(band.mean) / 1e6, peak(band.weak) / 1e6, peak(band.strong) / 1e6,
        band.mean.damage[0], band.strong.damage[0], band.weak.damage[0]);
    if (inputs.sizes[size] == inputs.reference_size) {
      write_curve(band.mean, "", output / "curve.csv");
      summary.set("cell_size", inputs.reference_size);
      summary.set("initial_damage", band.mean.damage[0]);
      summary.set("peak_stress", peak(band.mean));
      summary.set("peak_stress_weak", peak(band.weak));
      summary.set("peak_stress_strong", peak(band.strong));
    }
    mean.curves.push_back(std::move(band.mean));
    weak.curves.push_back(std::move(band.weak));
    strong.curves.push_back(std::move(band.strong));
  }
  char text[60];
  std::snprintf(text, sizeof text, ", quantile %g of the stress", inputs.ensemble.band);
  mean.crack_set += ", mean of " + std::to_string(samples.size()) + " samples";
  weak.crack_set += text;
  std::snprintf(text, sizeof text, ", quantile %g of the stress", 1 - inputs.ensemble.band);
  strong.crack_set += text;
  write_damage_table(weak, output / "damage_table_weak.h5");
  write_damage_table(strong, output / "damage_table_strong.h5");
  write_damage_table(mean, output / "damage_table.h5");
  write_damage_csv(mean, output / "damage_table.csv");
  summary.write(output / "summary.json");
  std::printf("  %d computed, %d reused; results in %s (damage_table.h5, damage_table_weak.h5, "
              "damage_table_strong.h5), %s\n",
              report.computed, report.reused, output.string().c_str(),
              format_duration(stopwatch.seconds()).c_str());
  return ExitCode::done;
}

ExitCode run(int argc, char** argv) {
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
  if (line.restart && inputs.ensemble.samples == 0)
    throw InputError("--restart: a single microcell takes seconds and has no checkpoint; ensembles have");
  check(inputs, line.input);
  const fs::path output = line.output;
  make_output_directory(output);

  // The problem is too small for threads to pay.
  dealii::MultithreadInfo::set_thread_limit(1);
  const Stopwatch stopwatch;
  const Provenance provenance = make_provenance(program, line.input, parameters.resolved());
  if (inputs.ensemble.samples > 0) return run_ensemble(inputs, line, provenance);
  Summary summary;
  common(summary, line);

  std::printf("%s: %s\n", program.c_str(), line.input.c_str());
  const Bulk bulk(inputs.geometry, inputs.mesh, inputs.poisson_ratio, inputs.boundary);
  const double condensation_seconds = stopwatch.seconds();
  const auto law = make_cohesive_law(inputs.softening, inputs.strength, inputs.fracture_energy);
  std::printf("  solid: %u unknowns condensed onto %td openings of the crack line in %.0f ms\n",
              bulk.dofs().n_dofs(), bulk.condensed().stiffness.rows(), condensation_seconds * 1e3);
  const MacroLoad<2> load = inputs.load<2>();
  const CondensedCell<2> cell = release(bulk.condensed(), load.free);
  const auto line_laws = inputs.line_laws();
  if (inputs.boundary == Boundary::linear_displacement) {
    const char* caution =
        "the edge of the cell follows the macroscopic strain, so that no crack can cross it: "
        "damage stays below 1. Use Cell/Boundary = periodic for a table";
    std::printf("  caution: %s\n", caution);
    summary.set("caution", caution);
  }
  std::fflush(stdout);

  DamageTable table = describe_table(inputs, provenance);
  table.curves.resize(inputs.sizes.size());
  Effort effort;
  EnergyChecks checks;
  const auto finish = [&](bool complete, const std::string& reason) {
    summary.set("dofs", static_cast<std::size_t>(bulk.dofs().n_dofs()));
    summary.set("condensed_unknowns", static_cast<std::size_t>(bulk.condensed().stiffness.rows()));
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
    InterfaceProblem<2> problem{.cell = cell,
                                .law = *law,
                                .youngs_modulus = inputs.youngs_modulus,
                                .cell_size = inputs.sizes[i],
                                .newton = inputs.newton,
                                .direction = load.direction,
                                .mode = inputs.mode};
    for (const auto& line_law : line_laws) problem.line_laws.push_back(line_law.get());
    const Stopwatch tracing;
    const CurveTrace<2> trace = trace_with_progress(problem, inputs.stepping);
    const double seconds = tracing.seconds();
    effort.add(trace, seconds);
    const std::string reason = trace.interrupted ? "interrupted" : trace.failure;
    if (reference) {
      write_curve(trace.curve, reason, output / "curve.csv");
      write_path(problem, bulk.condensed(), load, trace, inputs.poisson_ratio, output / "path.csv");
      summarise(summary, trace, problem);
      std::vector<CellState<2>> states = trace.states;
      for (CellState<2>& state : states)
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
    if (reference) checks = check_energies(trace.curve);
  }

  write_damage_table(table, output / "damage_table.h5");
  write_damage_csv(table, output / "damage_table.csv");
  finish(true, "");
  if (const double last = table.curves.front().damage.back(); last < 0.999)
    std::printf("  note: the table ends at damage %.3f\n", last);
  std::printf("  energy: work - dissipation - stored is within %.1e of the largest stored energy\n"
              "  results in %s (damage_table.h5, curve.csv, fields.pvd, summary.json), %s\n",
              checks.work, output.string().c_str(), format_duration(stopwatch.seconds()).c_str());
  return ExitCode::done;
}

} // namespace

int main(int argc, char** argv) {
  return spall::run_program("microcell", [&] { return run(argc, argv); });
}
