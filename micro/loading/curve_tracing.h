#pragma once

#include "micro/equilibrium/stability.h"
#include "micro/homogenization/damage.h"

#include <functional>
#include <string>
#include <vector>

namespace spall {

/// What to do where a cell has no stable equilibrium next to the last one.
enum class AtInstability { follow, refuse };

/// Step control of the strain from row to row. Strains are given in units that follow from cell and law.
struct SteppingSettings {
  double growth = 0.02;        ///< relative growth of the strain from row to row beyond the strain f_t / M
  double final_strain = 1.02;  ///< strain of the last row, in units of w_f / l, the strain of total failure
  double stress_change = 0.03; ///< largest change of stress from row to row, as a fraction of f_t
  /// Smallest step of strain control, in units of f_t / M; if it fails, damage control takes over.
  double smallest_step = 1e-4;
  /// First step of damage control, as a fraction of the energy of total failure; later steps adapt.
  double damage_step = 1e-3;
  double smallest_damage_step = 1e-9; ///< smallest step of damage control
  int most_rows = 20000;              ///< number of rows at which the computation fails
  /// Strains at which the loading reverses its direction, in order; may be empty.
  std::vector<double> turning_strains{};
  AtInstability snap_back = AtInstability::follow;
  AtInstability bifurcation = AtInstability::follow;
  /// Whether the stability of every row is computed for its report, which takes a fifth of the time of a
  /// curve; otherwise only where the tracing itself needs it.
  bool every_eigenvalue = true;
};

enum class Control { strain, damage };

/// Data of a row beside the columns of the curve.
struct RowReport {
  Control control = Control::strain;
  int iterations = 0;
  Stability stability; ///< stability of the row, without the modes
};

/// An instability on a curve that the user must know about.
struct CurveEvent {
  /// snap_back: the strain had to decrease between the two strains. bifurcation: the path branched at `from`
  /// and the stable branch was followed. branch_passed: branches of lower energy leave the path between the
  /// two strains, but none was found.
  enum class Kind { snap_back, bifurcation, branch_passed } kind = Kind::snap_back;
  double from = 0, to = 0; ///< strains at the beginning and at the end of the event
};

/// A traced curve and the states of its rows.
template<int dim> struct CurveTrace {
  DamageCurve curve;
  std::vector<CellState<dim>> states; ///< state of each row
  std::vector<RowReport> reports;     ///< report of each row
  std::vector<CurveEvent> events;
  std::string failure;      ///< reason why the curve ended early; empty if it is complete
  bool interrupted = false; ///< whether the curve ended early on request
  int newton_iterations = 0;
  int cut_steps = 0; ///< number of attempts that were repeated with half the step
  bool complete() const { return failure.empty() && !interrupted; }
};

/// Strains the unloaded cell along problem.direction. The step is constant (growth * f_t / M, M the modulus
/// along the direction) up to f_t / M, geometric beyond, and cut where Newton fails or the stress would
/// change by too much; w_f / l is always a row.
/// Where strain control has no stable next state, a stable branch next to the present one is searched along
/// the lowest eigenvector of the tangent stiffness (bifurcation). If there is none, the strain has a limit
/// point, and the dissipated energy is prescribed instead of the strain (damage control, snap-back) until
/// strain control works again. Under damage control one negative eigenvalue belongs to the decreasing strain;
/// a second one means that the path has passed a bifurcation, and the other branch is searched along the
/// eigenvectors of all negative eigenvalues. No viscosity is used: every row is an equilibrium.
/// `continue_after` is called after each row; the computation stops if it returns false.
template<int dim>
CurveTrace<dim> trace_curve(const InterfaceProblem<dim>& problem, const SteppingSettings& settings,
                            const std::function<bool(const DamageCurve&)>& continue_after);

} // namespace spall
