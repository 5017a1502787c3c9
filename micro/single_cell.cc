#include "micro/single_cell.h"

#include "micro/cell_problem.h"
#include "micro/ensemble/samples.h"
#include "micro/output/cell_report.h"
#include "micro/output/curve_file.h"
#include "micro/output/energy_report.h"
#include "micro/output/fields.h"
#include "micro/output/path_file.h"
#include "shared/damage_table.h"
#include "shared/program.h"
#include "shared/progress.h"
#include "shared/summary.h"
#include "shared/version.h"

#include <algorithm>
#include <cstdio>

namespace spall {
namespace fs = std::filesystem;
namespace {

/// One run over all sizes of a case.
template<int dim> class SingleCell {
public:
  SingleCell(const MicrocellInputs& inputs_, const Provenance& provenance_, const fs::path& output_)
      : inputs(inputs_), provenance(provenance_), output(output_) {}

  /// @throws ComputationError; the summary then says why there is no table
  ExitCode run() {
    try {
      return compute();
    } catch (const std::exception& error) {
      if (!reported) write_summary(error.what());
      throw;
    }
  }

private:
  ExitCode compute() {
    std::printf("%s: %s\n", provenance.program.c_str(), provenance.input_file.c_str());
    summary.set("program", "microcell");
    summary.set("version", version);
    summary.set("input_file", provenance.input_file);
    solid = make_solid<dim>(inputs, inputs.reference_size);
    describe_solid();
    DamageTable table = describe_table(inputs, provenance);
    table.youngs_modulus = solid.youngs_modulus;
    table.poisson_ratio = solid.poisson_ratio;
    table.curves.resize(inputs.sizes.size());
    for (const std::size_t i : reference_first()) {
      const CurveTrace<dim> trace = load_size(inputs.sizes[i]);
      if (trace.interrupted) return ExitCode::interrupted;
      table.curves[i] = envelope(trace.curve);
    }
    write_damage_table(table, output / "damage_table.h5");
    write_damage_csv(table, output / "damage_table.csv");
    write_summary("");
    if (const double last = table.curves.front().damage.back(); last < 0.999)
      std::printf("  note: the table ends at damage %.3f\n", last);
    std::printf("  results in %s (damage_table.h5, curve.csv, fields.pvd, summary.json), %s\n",
                output.string().c_str(), format_duration(stopwatch.seconds()).c_str());
    return ExitCode::done;
  }

  /// What was condensed, and what the user must know about it.
  void describe_solid() {
    condensation_seconds = stopwatch.seconds();
    const std::size_t dofs = solid.bulk->dofs().n_dofs(), openings = solid.bulk->condensed().stiffness.rows();
    std::printf("  solid: %zu unknowns condensed onto %zu openings of its cracks in %.0f ms\n", dofs,
                openings, condensation_seconds * 1e3);
    summary.set("dofs", dofs);
    summary.set("condensed_unknowns", openings);
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
  }

  /// Returns the indices of the sizes, the reference size first, so that its results exist even if a larger
  /// size fails.
  std::vector<std::size_t> reference_first() const {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < inputs.sizes.size(); ++i)
      order.insert(inputs.sizes[i] == inputs.reference_size ? order.begin() : order.end(), i);
    return order;
  }

  /// Loads the cell at one size and writes the files that belong to that size alone.
  /// @throws ComputationError if the curve ends early, after writing the rows so far
  CurveTrace<dim> load_size(double size) {
    const bool reference = size == inputs.reference_size;
    if (!reference && inputs.aggregates.present()) solid = make_solid<dim>(inputs, size);
    const CellProblem<dim> cell(inputs, solid, size);
    const Stopwatch tracing;
    CurveTrace<dim> trace = trace_with_progress(cell);
    const double seconds = tracing.seconds();
    steps += static_cast<int>(trace.curve.strain.size()) - 1;
    newton_iterations += trace.newton_iterations;
    cut_steps += trace.cut_steps;
    tracing_seconds += seconds;
    checks.include(trace.curve);
    const std::string reason = trace.interrupted ? "interrupted" : trace.failure;
    if (reference) {
      write_reference(cell, trace, reason);
    } else if (!reason.empty()) {
      char name[64];
      std::snprintf(name, sizeof name, "curve_%gmm.csv", size * 1e3);
      write_curve(trace.curve, reason, output / name);
    }
    if (!reason.empty()) write_summary(reason);
    if (!trace.failure.empty())
      throw ComputationError(reason + " (rows so far are kept in '" + output.string() +
                             "'; no damage table was written)");
    if (reason.empty()) {
      print_curve(trace.curve, seconds);
      print_events(trace.events);
    }
    return trace;
  }

  CurveTrace<dim> trace_with_progress(const CellProblem<dim>& cell) const {
    Progress progress;
    return cell.trace(inputs.stepping, [&](const DamageCurve& curve) {
      if (progress.due()) {
        char text[120];
        std::snprintf(text, sizeof text, "cell of %g mm: strain %.3g, damage %.3f", curve.cell_size * 1e3,
                      curve.strain.back(), curve.damage.back());
        progress.show(text);
      }
      return !interrupted();
    });
  }

  /// Writes curve, path, summary and fields of the reference size.
  /// @param incomplete reason why the curve ended early; empty if it is complete
  void write_reference(const CellProblem<dim>& cell, const CurveTrace<dim>& trace,
                       const std::string& incomplete) {
    const InterfaceProblem<dim>& problem = cell.equations();
    write_curve(trace.curve, incomplete, output / "curve.csv");
    write_path(problem, cell.solid(), cell.loading(), trace, output / "path.csv");
    summarise(summary, trace, problem);
    if (inputs.aggregates.present())
      summarise_paths(summary, problem, trace.states.back(),
                      aggregate_diameters(inputs.aggregates.grading, problem.cell_size).size());
    std::vector<CellState<dim>> states = trace.states;
    for (CellState<dim>& state : states)
      state.strain =
          complete_strain(cell.solid(), cell.loading().free, state.strain, state.opening / problem.cell_size);
    write_fields(*solid.bulk, problem, states, rows_to_show(trace.curve, inputs.field_states), output);
  }

  /// @param incomplete reason why there is no table; empty if there is one
  void write_summary(const std::string& incomplete) {
    summary.set("steps", steps);
    summary.set("newton_iterations", newton_iterations);
    summary.set("cut_steps", cut_steps);
    summary.set("wall_seconds", stopwatch.seconds());
    summary.set("cpu_seconds", stopwatch.cpu_seconds());
    summary.set("condensation_seconds", condensation_seconds);
    summary.set("seconds_per_load_step", tracing_seconds / std::max(1, steps));
    summary.set("peak_memory_bytes", peak_memory_bytes());
    summary.set("ranks", 1);
    summary.set("threads", 1);
    report_energies(checks, inputs.mode.friction > 0, summary);
    summary.set("complete", incomplete.empty());
    if (!incomplete.empty()) summary.set("reason", incomplete), reported = true;
    summary.write(output / "summary.json");
  }

  const MicrocellInputs& inputs;
  const Provenance& provenance;
  const fs::path& output;
  const Stopwatch stopwatch;
  Summary summary;
  Solid<dim> solid;                                    ///< the solid of the present size
  EnergyChecks checks;                                 ///< largest errors over all sizes
  int steps = 0, newton_iterations = 0, cut_steps = 0; ///< sums over the sizes
  double tracing_seconds = 0, condensation_seconds = 0;
  bool reported = false; ///< whether the summary says why there is no table
};

} // namespace

ExitCode run_single_cell(const MicrocellInputs& inputs, const Provenance& provenance,
                         const fs::path& output) {
  return inputs.dimension == 3 ? SingleCell<3>(inputs, provenance, output).run()
                               : SingleCell<2>(inputs, provenance, output).run();
}

} // namespace spall
