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

/// One cell of real size with its cohesive laws and the direction of its macroscopic strain.
template<int dim> struct InterfaceProblem {
  const CondensedCell<dim>& cell;
  const CohesiveLaw& law;
  double youngs_modulus = 0; ///< Young's modulus E, Pa
  double cell_size = 0;      ///< edge length l, m
  NewtonSettings newton{};
  /// Direction of the macroscopic strain; by default tension along y.
  Voigt<dim> direction = Voigt<dim>::Unit(1);
  MixedMode mode{};
  /// The law of each crack line, if lines differ; empty: all lines have `law`.
  std::vector<const CohesiveLaw*> line_laws{};

  const CohesiveLaw& law_at(std::size_t node) const {
    return line_laws.empty() ? law : *line_laws[cell.nodes[node].line];
  }
};

/// State of a cell: macroscopic strain, openings and history variables.
template<int dim> struct CellState {
  Voigt<dim> strain = Voigt<dim>::Zero();
  Eigen::VectorXd opening;        ///< openings, m: dim per node, normal, then tangential
  std::vector<double> largest;    ///< largest effective opening so far of each node, m
  std::vector<double> dissipated; ///< energy dissipated by the law at each node, J/m^2; integrated only if it
                                  ///< depends on the path
  double friction_work = 0;       ///< energy dissipated by friction per volume, J/m^3
};

/// Returns the state of the unloaded cell: ligaments are intact, initial cracks are fully broken.
template<int dim> CellState<dim> unloaded_state(const InterfaceProblem<dim>& problem);

struct NewtonReport {
  enum class Outcome { converged, not_converged, unstable } outcome = Outcome::not_converged;
  int iterations = 0;
  double traction_error = 0; ///< largest traction error over the nodes, Pa
};
/// Describes the outcome in a few words, for messages.
std::string describe(const NewtonReport& report);

/// Brings `state` into equilibrium at macroscopic strain `strain`: the bulk's traction on every crack node
/// obeys the law exactly (rigid, softening, unloading, broken, contact). The method is a semismooth Newton
/// iteration on the augmented tractions, which is an active-set method; the unknowns of closed nodes drop
/// out. `guess` holds the openings that the iteration starts from. On failure `state` is unchanged. If the
/// tangent stiffness is not positive definite, the equilibrium is not unique or is unstable under strain
/// control (snap-back), and the result is Outcome::unstable. If the law's tangent is not symmetric, the
/// criterion is an eigenvalue with a negative real part.
template<int dim>
NewtonReport equilibrate(const InterfaceProblem<dim>& problem, const Voigt<dim>& strain,
                         const Eigen::VectorXd& guess, CellState<dim>& state);

/// Path following with damage control, a form of arc-length continuation: finds the equilibrium at strain
/// `load` * problem.direction with the unknown `load` at which damage_measure() reaches `measure`. It passes
/// limit points of stress and strain, where equilibrate() fails, and does not check stability. `guess` is the
/// state that the iteration starts from.
template<int dim>
NewtonReport equilibrate_damage(const InterfaceProblem<dim>& problem, double measure,
                                const CellState<dim>& guess, CellState<dim>& state);

/// Returns the energy per volume that the law would have dissipated for the largest effective openings if all
/// modes were alike, J/m^3. Damage control prescribes this quantity because it grows whenever any crack grows
/// and depends on nothing else.
template<int dim> double damage_measure(const InterfaceProblem<dim>& problem, const CellState<dim>& state);

} // namespace spall
