#pragma once

#include "micro/cohesive/cohesive_law.h"
#include "micro/equilibrium/condensed_cell.h"

#include <string>

namespace spall {

struct NewtonSettings {
  double tolerance = 1e-9; ///< largest traction error of a converged state, fraction of the strength
  int max_iterations = 40;
};

/// One cell of real size with its cohesive law.
struct InterfaceProblem {
  const CondensedCell& cell;
  const CohesiveLaw& law;
  double youngs_modulus = 0; ///< E, Pa
  double cell_size = 0;      ///< l, m
  NewtonSettings newton{};
};

/// What a cell remembers.
struct CellState {
  Voigt strain = Voigt::Zero();
  Eigen::VectorXd opening;     ///< 2 per node: normal, tangential, m
  std::vector<double> largest; ///< largest effective opening so far per node, m
};

/// The unloaded cell: ligament intact, initial crack broken from the start.
CellState unloaded_state(const InterfaceProblem& problem);

struct NewtonReport {
  enum class Outcome { converged, not_converged, unstable } outcome = Outcome::not_converged;
  int iterations = 0;
  double traction_error = 0; ///< largest over the nodes, Pa
};
/// In words, for messages.
std::string describe(const NewtonReport& report);

/// Brings `state` into equilibrium at macroscopic strain `strain`: the bulk's traction on every crack node
/// obeys the law exactly (rigid, softening, unloading, broken, contact). Semismooth Newton on the augmented
/// tractions, which is an active-set method; unknowns of closed nodes drop out. `guess` holds openings to
/// start from. On failure `state` is untouched. A tangent that is not positive definite means that the
/// equilibrium is not unique or unstable under strain control (snap-back): Outcome::unstable.
NewtonReport equilibrate(const InterfaceProblem& problem, const Voigt& strain, const Eigen::VectorXd& guess,
                         CellState& state);

} // namespace spall
