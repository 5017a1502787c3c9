#pragma once

#include "micro/equilibrium/interface_problem.h"

namespace spall {

/// Stability of a state against small disturbances at constant macroscopic strain. Eigenvalues of the
/// condensed tangent against the area each node stands for, so that they hardly depend on the mesh, in units
/// of E / l.
///
/// Where the tangent is symmetric both numbers tell the same. Where it is not (friction, other energy in
/// shear) `lowest` > 0 is sufficient for stability and bounds the real parts of the eigenvalues from below,
/// while `negative` counts the disturbances that do grow; lowest < 0 with none that grows leaves it open.
struct Stability {
  double lowest = 0; ///< lowest eigenvalue of the symmetric part; NaN where nothing is open
  int negative = 0;  ///< eigenvalues of the tangent with a negative real part: 0 stable; 1 beyond a limit of
                     ///< strain or on an unstable branch; more: surely on an unstable branch
  Eigen::MatrixXd modes; ///< columns: openings (dim per node) of the negative eigenvalues of the symmetric
                         ///< part, of the lowest one if none is; largest component 1; empty where unknown
};

/// Of a converged state, with damaged nodes taken as loading. Stable states cost a factorisation, others all
/// eigenvalues.
template<int dim> Stability stability(const InterfaceProblem<dim>& problem, const CellState<dim>& state);

/// Number of eigenvalues with a negative real part of a tangent that need not be symmetric, against the areas
/// of its rows; those below round-off count as neutral.
int growing_disturbances(const Eigen::MatrixXd& tangent, const Eigen::VectorXd& areas);

} // namespace spall
