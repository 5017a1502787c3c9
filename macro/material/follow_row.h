#pragma once

#include "macro/material/single_point.h"
#include "macro/material/strain_path.h"

#include <optional>

namespace spall {

/// Strain of a step that a row is first divided into: a fifth of what concrete cracks at, so that no row,
/// however large, jumps over the events in it.
constexpr double first_step_of_row = 2e-5;
/// Steps after which a row is given up.
constexpr int most_steps_of_row = 1 << 20;

namespace detail {

template<class Law>
SinglePoint<Law> in_steps(SinglePoint<Law> point, const PathRow& row, int steps, Lateral lateral) {
  const Sym3 increment = 1.0 / steps * row.strain;
  for (int step = 0; step < steps; ++step)
    if (lateral == Lateral::stress_free)
      point.advance_with_free_sides(increment[0], row.time / steps);
    else
      point.advance(increment, row.time / steps);
  return point;
}

/// Largest difference of two results of one row: of the stress over the largest stress, and of the work over
/// the work exchanged.
template<class Law> double difference(const SinglePoint<Law>& a, const SinglePoint<Law>& b) {
  const double stress = largest_component(b.stress - a.stress), work = std::abs(b.work - a.work);
  return std::max(stress > 0 ? stress / b.largest_stress : 0, work > 0 ? work / b.exchanged_work : 0);
}

} // namespace detail

/// The point after one row of a path (its increments of time and strain) in equal steps: `options.substeps`
/// if the tolerance is 0. Otherwise at least as many, and twice as many until stress and work change by less
/// than the tolerance: their errors are then about as large, as the stress is of first order in the step.
/// @throws ComputationError: not with most_steps_of_row, or no lateral strain is found
template<class Law>
SinglePoint<Law> follow_row(const SinglePoint<Law>& start, const PathRow& row, const PathOptions& options) {
  if (!(options.tolerance > 0)) return detail::in_steps(start, row, options.substeps, options.lateral);
  const double wanted = std::ceil(largest_component(row.strain) / first_step_of_row);
  int steps = std::max(options.substeps, static_cast<int>(std::min<double>(wanted, most_steps_of_row / 2)));
  std::optional<SinglePoint<Law>> coarse;
  for (double change = 0;; steps *= 2) {
    try {
      const SinglePoint<Law> fine = detail::in_steps(start, row, steps, options.lateral);
      if (coarse) {
        change = detail::difference(*coarse, fine);
        if (change <= options.tolerance) return fine;
      }
      coarse.emplace(fine);
    } catch (const ComputationError&) {
      if (steps >= most_steps_of_row) throw;
    }
    if (steps >= most_steps_of_row)
      throw ComputationError("stress or work still changes by " + format_quantity(change, Dimension::none) +
                             " with " + std::to_string(steps) + " steps from one row to the next, allowed: " +
                             format_quantity(options.tolerance, Dimension::none) + " (Path/Tolerance)");
  }
}

} // namespace spall
