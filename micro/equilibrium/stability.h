#pragma once

#include "micro/equilibrium/interface_problem.h"

namespace spall {

/// How a state answers to small disturbances at constant macroscopic strain. Eigenvalues of the condensed
/// tangent against the length each node stands for, so that they hardly depend on the mesh, in units of E /
/// l.
struct Stability {
  double lowest = 0; ///< lowest eigenvalue; NaN where nothing is open
  int negative = 0;  ///< number of negative ones: 0 stable; 1 beyond a limit of strain or on an unstable
                     ///< branch; more: surely on an unstable branch
  Eigen::VectorXd
      mode; ///< openings of the lowest one (dim per node), largest component 1; empty where unknown
};

/// Of a converged state, with damaged nodes taken as loading. Stable states cost a factorisation, others all
/// eigenvalues. The symmetric part counts where the tangent is not symmetric.
template<int dim> Stability stability(const InterfaceProblem<dim>& problem, const CellState<dim>& state);

} // namespace spall
