#pragma once

#include "micro/equilibrium/interface_problem.h"

namespace spall {

/// Stability of a state against small disturbances at constant macroscopic strain, from the generalised
/// eigenvalues of the condensed tangent stiffness and the nodes' crack areas. Because of the areas the
/// eigenvalues hardly depend on the mesh. They are given in units of E / l. If the tangent is symmetric, both
/// criteria agree. If it is not (friction, a different fracture energy in shear), `lowest` > 0 is sufficient
/// for stability and bounds the real parts of the eigenvalues from below, while `negative` counts the
/// disturbances that grow. With lowest < 0 and negative = 0 the stability is undecided.
struct Stability {
  double lowest = 0; ///< lowest eigenvalue of the tangent's symmetric part; NaN if no crack is open
  int negative = 0;  ///< number of eigenvalues of the tangent with a negative real part. 0: stable; 1: beyond
                     ///< a limit point of strain or on an unstable branch; more: on an unstable branch
  Eigen::MatrixXd modes; ///< eigenvectors as columns of openings (dim per node), scaled to a largest
                         ///< component of 1: those of the negative eigenvalues of the symmetric part, or of
                         ///< the lowest eigenvalue if none is negative; empty if unknown
};

/// Computes the stability of a converged state; damaged nodes are assumed to load further. A stable state
/// costs one factorisation, an unstable one all eigenvalues.
template<int dim> Stability stability(const InterfaceProblem<dim>& problem, const CellState<dim>& state);

/// Returns the number of generalised eigenvalues with a negative real part. @param tangent tangent stiffness,
/// perhaps not symmetric; @param areas crack area of each row. Eigenvalues below round-off count as zero.
int growing_disturbances(const Eigen::MatrixXd& tangent, const Eigen::VectorXd& areas);

} // namespace spall
