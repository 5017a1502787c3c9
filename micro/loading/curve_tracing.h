#pragma once

#include "micro/equilibrium/stability.h"
#include "micro/homogenization/damage.h"

#include <functional>
#include <string>
#include <vector>

namespace spall {

/// Action where a cell has no stable equilibrium next to the last one.
enum class AtInstability { follow, refuse };

/// How the strain of a cell grows from row to row. Strains are in units that follow from cell and law.
struct SteppingSettings {
  double growth = 0.02;        ///< strain of a row over the last one, minus 1, beyond the strain f_t / M
  double final_strain = 1.02;  ///< last row, in units of w_f / l, the strain of total failure
  double stress_change = 0.03; ///< largest change of stress from row to row, fraction of f_t
  double smallest_step = 1e-4; ///< in units of f_t / M: below it strain control gives up
  /// Share of the energy of total failure that the first row of path control dissipates; later rows adapt.
  double damage_step = 1e-3;
  double smallest_damage_step = 1e-9;    ///< below it path control gives up
  int most_rows = 20000;                 ///< the computation ends there
  std::vector<double> turning_strains{}; ///< where the strain turns round on its way, absolute; may be empty
  AtInstability snap_back = AtInstability::follow;
  AtInstability bifurcation = AtInstability::follow;
  /// Stability of every row, for its report; else only where the tracing itself asks for it. A fifth of the
  /// time of a curve.
  bool every_eigenvalue = true;
};

enum class Control { strain, damage };

/// How a row was found: what is known of it beside the columns of the curve.
struct RowReport {
  Control control = Control::strain;
  int iterations = 0;
  Stability stability; ///< its modes are not kept
};

/// Something a user must know about a curve.
struct CurveEvent {
  /// snap_back: strain had to fall, from where to where. bifurcation: the path branched at `from` and the
  /// branch that other paths do not leave was followed. branch_passed: paths of lower energy leave the one
  /// followed between the two strains, and none was found.
  enum class Kind { snap_back, bifurcation, branch_passed } kind = Kind::snap_back;
  double from = 0, to = 0; ///< strains
};

/// A traced curve and the states of its rows.
template<int dim> struct CurveTrace {
  DamageCurve curve;
  std::vector<CellState<dim>> states; ///< one per row
  std::vector<RowReport> reports;     ///< one per row
  std::vector<CurveEvent> events;
  std::string failure;      ///< why it ended early; empty if complete
  bool interrupted = false; ///< ended early on request
  int newton_iterations = 0;
  int cut_steps = 0; ///< attempts repeated with half the step
  bool complete() const { return failure.empty() && !interrupted; }
};

/// Strains the unloaded cell along problem.direction. The step is constant (growth * f_t / M, M the modulus
/// along the direction) up to f_t / M, geometric beyond, and cut where Newton fails or the stress would
/// change by too much; w_f / l is always a row.
///
/// Where strain control has no stable next state, a stable branch beside the present one is looked for along
/// the lowest mode of the tangent (bifurcation); if there is none, the strain has a limit and the damage done
/// is prescribed instead (snap-back) until strain control works again. While the damage is prescribed one
/// negative eigenvalue belongs to the falling strain; with a second one the path has passed a branch, which
/// is looked for along the modes of all negative ones. No viscosity is involved: every row is an equilibrium.
/// `continue_after` is asked after each row.
template<int dim>
CurveTrace<dim> trace_curve(const InterfaceProblem<dim>& problem, const SteppingSettings& settings,
                            const std::function<bool(const DamageCurve&)>& continue_after);

} // namespace spall
