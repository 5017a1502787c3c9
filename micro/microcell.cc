// From cracks in a cell of concrete to a damage table: pulls cracked cells of several sizes apart and writes
// what they answer, for the macroscopic model to use.

#include "micro/equilibrium/bulk.h"
#include "micro/inputs.h"
#include "micro/output/curve_file.h"
#include "micro/output/fields.h"
#include "shared/damage_table.h"
#include "shared/output_directory.h"
#include "shared/program.h"
#include "shared/progress.h"
#include "shared/provenance.h"
#include "shared/summary.h"
#include "shared/version.h"

#include <deal.II/base/multithread_info.h>

#include <algorithm>
#include <cstdio>

namespace {

using namespace spall;
namespace fs = std::filesystem;

const std::string program = std::string("microcell ") + version;

void print_help(const Parameters& parameters) {
  std::printf("microcell CASE.prm [--output DIR] [Section/Key=value ...]\n\n"
              "Pulls a square cell of concrete with a crack apart, for each cell size, and writes into DIR "
              "(default: out)\n"
              "  damage_table.h5, .csv  damage against strain for each size: the input of penetrate\n"
              "  curve.csv              the curve of the reference size in full\n"
              "  fields.pvd             displacement and stress of the reference cell, for ParaView\n"
              "  summary.json           what was computed, how fast, and how well energy is balanced\n\n"
              "Every key of CASE.prm:\n%s",
              parameters.help().c_str());
}

DamageTable describe_table(const MicrocellInputs& inputs, const Provenance& provenance) {
  DamageTable table;
  table.youngs_modulus = inputs.youngs_modulus;
  table.poisson_ratio = inputs.poisson_ratio;
  table.tensile_strength = inputs.strength;
  table.fracture_energy = inputs.fracture_energy;
  for (const auto& [word, softening] : softening_words())
    if (softening == inputs.softening) table.softening = word;
  table.crack_set =
      inputs.geometry.crack_ratio == 0
          ? "no initial crack, cohesive line across the cell"
          : "one centred crack, 2 a0 / l = " + format_quantity(inputs.geometry.crack_ratio, Dimension::none);
  table.boundary = "periodic";
  table.provenance = provenance;
  return table;
}

/// Traces one size under a progress line.
CurveTrace trace_with_progress(const InterfaceProblem& problem, const SteppingSettings& stepping) {
  Progress progress;
  return trace_curve(problem, stepping, [&](const CurveTrace& trace) {
    if (progress.due()) {
      char text[120];
      std::snprintf(text, sizeof text, "cell of %g mm: strain %.3g, damage %.3f", problem.cell_size * 1e3,
                    trace.curve.strain.back(), trace.curve.damage.back());
      progress.show(text);
    }
    return !interrupted();
  });
}

/// Totals over all sizes.
struct Effort {
  int steps = 0, newton_iterations = 0, cut_steps = 0;
  double tracing_seconds = 0;
  void add(const CurveTrace& trace, double seconds) {
    steps += static_cast<int>(trace.curve.strain.size()) - 1;
    newton_iterations += trace.newton_iterations;
    cut_steps += trace.cut_steps;
    tracing_seconds += seconds;
  }
};

/// What the curve of the reference size says, for summary.json.
void summarise(Summary& summary, const DamageCurve& curve, const MicrocellInputs& inputs) {
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
  summary.set("work_to_failure_expected",
              inputs.fracture_energy * (1 - inputs.geometry.crack_ratio) / curve.cell_size);
  summary.set("energy_balance_error", checks.work);
  summary.set("psi_against_stress_error", checks.stress);
}

void print_curve(const DamageCurve& curve, double seconds) {
  const auto peak = std::max_element(curve.stress.begin(), curve.stress.end());
  std::printf("  cell of %8.5g mm: peak %.3f MPa at strain %.3e, damage %.3f to %.3f, %zu rows, %.0f ms\n",
              curve.cell_size * 1e3, *peak / 1e6, curve.strain[peak - curve.stress.begin()],
              curve.damage.front(), curve.damage.back(), curve.strain.size(), seconds * 1e3);
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
  if (line.restart) throw InputError("--restart: a microcell takes seconds and has no checkpoint");
  parameters.read(line.input, line.overrides);
  check(inputs, line.input);
  const fs::path output = line.output;
  make_output_directory(output);

  // The problem is too small for threads to pay.
  dealii::MultithreadInfo::set_thread_limit(1);
  const Stopwatch stopwatch;
  const Provenance provenance = make_provenance(program, line.input, parameters.resolved());
  Summary summary;
  summary.set("program", std::string("microcell"));
  summary.set("version", version);
  summary.set("input_file", line.input);

  std::printf("%s: %s\n", program.c_str(), line.input.c_str());
  const Bulk bulk(inputs.geometry, inputs.mesh, inputs.poisson_ratio);
  const double condensation_seconds = stopwatch.seconds();
  const auto law = make_cohesive_law(inputs.softening, inputs.strength, inputs.fracture_energy);
  std::printf("  solid: %u unknowns condensed onto %td openings of the crack line in %.0f ms\n",
              bulk.dofs().n_dofs(), bulk.condensed().stiffness.rows(), condensation_seconds * 1e3);
  std::fflush(stdout);

  DamageTable table = describe_table(inputs, provenance);
  table.curves.resize(inputs.sizes.size());
  Effort effort;
  const auto finish = [&](bool complete, const std::string& reason) {
    summary.set("dofs", static_cast<std::size_t>(bulk.dofs().n_dofs()));
    summary.set("condensed_unknowns", static_cast<std::size_t>(bulk.condensed().stiffness.rows()));
    summary.set("steps", effort.steps);
    summary.set("newton_iterations", effort.newton_iterations);
    summary.set("cut_steps", effort.cut_steps);
    summary.set("wall_seconds", stopwatch.seconds());
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
    const InterfaceProblem problem{.cell = bulk.condensed(),
                                   .law = *law,
                                   .youngs_modulus = inputs.youngs_modulus,
                                   .cell_size = inputs.sizes[i],
                                   .newton = inputs.newton};
    const Stopwatch tracing;
    CurveTrace trace = trace_with_progress(problem, inputs.stepping);
    const double seconds = tracing.seconds();
    effort.add(trace, seconds);
    const std::string reason = trace.interrupted ? "interrupted" : trace.failure;
    if (reference) {
      write_curve(trace.curve, reason, output / "curve.csv");
      summarise(summary, trace.curve, inputs);
      write_fields(bulk, problem, trace.states, rows_to_show(trace.curve, inputs.field_states), output);
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
    table.curves[i] = std::move(trace.curve);
  }

  write_damage_table(table, output / "damage_table.h5");
  write_damage_csv(table, output / "damage_table.csv");
  finish(true, "");
  if (const double last = table.curves.front().damage.back(); last < 0.999)
    std::printf("  note: the table ends at damage %.3f, because Loading/Final strain is below 1\n", last);
  const EnergyChecks checks = check_energies(table.curves[order.front()]);
  std::printf("  energy: work - dissipation - stored is within %.1e of the largest stored energy\n"
              "  results in %s (damage_table.h5, curve.csv, fields.pvd, summary.json), %s\n",
              checks.work, output.string().c_str(), format_duration(stopwatch.seconds()).c_str());
  return ExitCode::done;
}

} // namespace

int main(int argc, char** argv) {
  return spall::run_program("microcell", [&] { return run(argc, argv); });
}
