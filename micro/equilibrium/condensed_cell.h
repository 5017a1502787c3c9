#pragma once

#include <Eigen/Core>

#include <vector>

namespace spall {

/// Macroscopic strain or stress of plane strain: xx, yy, xy; the shear strain is the engineering one (2
/// e_xy).
using Voigt = Eigen::Vector3d;

/// A pair of nodes facing each other across a crack line.
struct CrackNode {
  double position = 0;         ///< x in the unit cell
  double weight = 0;           ///< length it stands for, fraction of the edge (lumped quadrature)
  bool initially_open = false; ///< on an initial crack: carries no traction but contact
  int line = 0;                ///< crack line it lies on
};

/// The bulk of the cell seen from its crack: a quadratic form in the openings w (2 per node: normal,
/// tangential) and the macroscopic strain e, for edge 1 and Young's modulus 1. With real E and l, in 2D, the
/// elastic energy per thickness is
///   E (w.S w / 2 - l w.G e + l^2 e.C e / 2),
/// so one condensation serves every cell size, strength and fracture energy; it depends on Poisson's ratio,
/// the crack and the mesh only.
struct CondensedCell {
  Eigen::MatrixXd stiffness; ///< S, 2n x 2n, symmetric positive definite
  Eigen::MatrixXd coupling;  ///< G, 2n x 3
  Eigen::Matrix3d uncracked; ///< C: stiffness of the cell with the crack line held closed
  std::vector<CrackNode> nodes;
};

} // namespace spall
