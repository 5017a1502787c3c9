#include "micro/output/cell_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace spall {
namespace {

/// Adds the stability of the rows and the number of events on the path to the summary.
template<int dim> void summarise_stability(Summary& summary, const CurveTrace<dim>& trace) {
  double lowest = std::numeric_limits<double>::infinity();
  int negative = 0, prescribed = 0, branches = 0, snaps = 0, passed = 0;
  for (const RowReport& row : trace.reports) {
    if (!std::isnan(row.stability.lowest)) lowest = std::min(lowest, row.stability.lowest);
    negative = std::max(negative, row.stability.negative);
    prescribed += row.control == Control::damage;
  }
  // If the tangent is not symmetric, neither test decides the stability of some rows.
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

} // namespace

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
  // With one line across the cell the work is G_f times the length of its ligament. Of several lines perhaps
  // only one fails, so that the work is not known in advance.
  double ligament = 0;
  int lines = 0;
  for (const CrackNode& node : problem.cell.nodes) {
    if (!node.initially_open) ligament += node.weight;
    lines = std::max(lines, node.line + 1);
  }
  if (lines == 1)
    summary.set("work_to_failure_expected",
                problem.law.work(problem.law.final_opening()) * ligament / curve.cell_size);
  summarise_stability(summary, trace);
}

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

void print_curve(const DamageCurve& curve, double seconds) {
  const auto peak = std::max_element(curve.stress.begin(), curve.stress.end());
  std::printf("  cell of %8.5g mm: peak %.3f MPa at strain %.3e, damage %.3f to %.3f, %zu rows, %.0f ms\n",
              curve.cell_size * 1e3, *peak / 1e6, curve.strain[peak - curve.stress.begin()],
              curve.damage.front(), curve.damage.back(), curve.strain.size(), seconds * 1e3);
}

void print_events(const std::vector<CurveEvent>& events) {
  int snaps = 0;
  double deepest = 0, from = 0, to = 0;
  for (const CurveEvent& event : events) {
    if (event.kind == CurveEvent::Kind::bifurcation) {
      std::printf(
          "    the equilibrium path branches at strain %.4g; the branch of lower energy was followed\n",
          event.from);
      continue;
    }
    if (event.kind == CurveEvent::Kind::branch_passed) {
      std::printf("    caution: the symmetric path was followed: between strains %.4g and %.4g branches of "
                  "lower energy leave it, for instance with only one of several equal crack tips growing, "
                  "but none was found\n",
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
    std::printf("    %d snap-back(s), the largest from strain %.4g back to %.4g, followed by damage control; "
                "the table holds the envelope\n",
                snaps, from, to);
}

#define SPALL_INSTANTIATE(dim)                                                                               \
  template void summarise(Summary&, const CurveTrace<dim>&, const InterfaceProblem<dim>&);                   \
  template void summarise_paths(Summary&, const InterfaceProblem<dim>&, const CellState<dim>&, std::size_t);
SPALL_INSTANTIATE(2)
SPALL_INSTANTIATE(3)
#undef SPALL_INSTANTIATE

} // namespace spall
