#pragma once

#include "micro/cohesive/cohesive_law.h"
#include "micro/cohesive/mixed_mode.h"
#include "micro/equilibrium/condensed_cell.h"

#include <string>
#include <vector>

namespace spall {

struct NewtonSettings {
  double tolerance = 1e-9; ///< largest traction error of a converged state, fraction of the strength
  int max_iterations = 40;
};

/// One cell of real size with its cohesive law, and how it is strained.
template<int dim> struct InterfaceProblem {
  const CondensedCell<dim>& cell;
  const CohesiveLaw& law;
  double youngs_modulus = 0; ///< E, Pa
  double cell_size = 0;      ///< l, m
  NewtonSettings newton{};
  Voigt<dim> direction = Voigt<dim>::Unit(1); ///< of the macroscopic strain; by default a pull along y
  MixedMode mode{};
  /// Laws of single crack lines where they differ from `law`; empty: none does.
  std::vector<const CohesiveLaw*> line_laws{};

  const CohesiveLaw& law_at(std::size_t node) const {
    return line_laws.empty() ? law : *line_laws[cell.nodes[node].line];
  }
};

/// State of a cell: its strain, openings and history.
template<int dim> struct CellState {
  Voigt<dim> strain = Voigt<dim>::Zero();
  Eigen::VectorXd opening;        ///< dim per node: normal, then tangential, m
  std::vector<double> largest;    ///< largest effective opening so far per node, m
  std::vector<double> dissipated; ///< by the law, per node, J/m^2; followed where it depends on the path
  double friction_work = 0;       ///< dissipated by friction, per volume, J/m^3
};

/// The unloaded cell: ligaments intact, initial cracks broken from the start.
template<int dim> CellState<dim> unloaded_state(const InterfaceProblem<dim>& problem);

struct NewtonReport {
  enum class Outcome { converged, not_converged, unstable } outcome = Outcome::not_converged;
  int iterations = 0;
  double traction_error = 0; ///< largest over the nodes, Pa
};
/// The outcome in words, for messages.
std::string describe(const NewtonReport& report);

/// Brings `state` into equilibrium at macroscopic strain `strain`: the bulk's traction on every crack node
/// obeys the law exactly (rigid, softening, unloading, broken, contact). Semismooth Newton on the augmented
/// tractions, which is an active-set method; unknowns of closed nodes drop out. `guess` holds openings to
/// start from. On failure `state` is untouched. A tangent that is not positive definite means that the
/// equilibrium is not unique or unstable under strain control (snap-back): Outcome::unstable. With a law
/// whose tangent is not symmetric, an eigenvalue with a negative real part says so.
template<int dim>
NewtonReport equilibrate(const InterfaceProblem<dim>& problem, const Voigt<dim>& strain,
                         const Eigen::VectorXd& guess, CellState<dim>& state);

/// The same where the size of the strain is not given but the damage done: finds equilibrium at strain
/// `load` * problem.direction for the `load` at which damage_measure() grows to `measure`. Passes limit
/// points of stress and strain, where equilibrate() fails; does not judge stability. `guess` is where to
/// start from.
template<int dim>
NewtonReport equilibrate_damage(const InterfaceProblem<dim>& problem, double measure,
                                const CellState<dim>& guess, CellState<dim>& state);

/// Energy that the law would have dissipated for the largest openings reached if all modes counted alike, per
/// volume, J/m^3: what path control prescribes, as it grows whenever any crack does and depends on nothing
/// else.
template<int dim> double damage_measure(const InterfaceProblem<dim>& problem, const CellState<dim>& state);

} // namespace spall
