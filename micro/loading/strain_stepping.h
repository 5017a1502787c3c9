#pragma once

#include "micro/homogenization/damage.h"

#include <functional>
#include <string>
#include <vector>

namespace spall {

/// How a cell is pulled: strain grows row by row. Strains are in units that belong to the cell and law.
struct SteppingSettings {
  double growth = 0.02;        ///< strain of a row over the last one, minus 1, beyond the strain f_t / M
  double final_strain = 1.02;  ///< last row, in units of w_f / l, the strain of total failure
  double stress_change = 0.03; ///< largest change of stress from row to row, fraction of f_t
  double smallest_step = 1e-4; ///< in units of f_t / M: below it the stepping gives up
};

/// A traced curve and the states of its rows.
struct CurveTrace {
  DamageCurve curve;
  std::vector<CellState> states; ///< one per row
  std::string failure;           ///< why it ended early; empty if complete
  bool interrupted = false;      ///< ended early on request
  int newton_iterations = 0;
  int cut_steps = 0; ///< attempts repeated with half the step
  bool complete() const { return failure.empty() && !interrupted; }
};

/// Pulls the unloaded cell in uniaxial strain normal to its crack. The step is constant (growth * f_t / M, M
/// the modulus of uniaxial strain) up to f_t / M, geometric beyond, and cut where Newton fails or the stress
/// would change by too much; w_f / l is always a row. `continue_after` is asked after each row.
CurveTrace trace_curve(const InterfaceProblem& problem, const SteppingSettings& settings,
                       const std::function<bool(const CurveTrace&)>& continue_after);

} // namespace spall
