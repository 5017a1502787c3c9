#pragma once

#include <Eigen/Core>

#include <array>
#include <vector>

namespace spall {

template<int dim> inline constexpr int voigt_size = dim*(dim + 1) / 2;
/// Macroscopic strain or stress: xx, yy, xy in plane strain; xx, yy, zz, xy, yz, xz in 3D, the order of the
/// macroscopic program too. Shear strains are the engineering ones (2 e_xy).
template<int dim> using Voigt = Eigen::Matrix<double, voigt_size<dim>, 1>;
template<int dim> using VoigtMatrix = Eigen::Matrix<double, voigt_size<dim>, voigt_size<dim>>;
/// Row and column in the tensor of the i-th component of a Voigt<dim>.
template<int dim> constexpr std::array<int, 2> tensor_index(int i) {
  if (i < dim) return {i, i};
  constexpr std::array<std::array<int, 2>, 3> shear = {{{0, 1}, {1, 2}, {0, 2}}};
  return shear[i - dim];
}

/// A pair of nodes facing each other across a crack.
struct CrackNode {
  std::array<double, 3> position{}; ///< in the unit cell; z is 0 in 2D
  double weight = 0;                ///< length or area it stands for, of the unit cell (lumped quadrature)
  bool initially_open = false;      ///< on an initial crack: it transmits contact pressure only
  int line = 0;                     ///< crack line it lies on
};

/// The bulk of the cell condensed onto its cracks: a quadratic form in the openings w (dim per node: normal,
/// then tangential) and the macroscopic strain e, for edge 1 and Young's modulus 1. With real E and l the
/// elastic energy is
///   E l^(dim-2) (w.S w / 2 - l w.G e + l^2 e.C e / 2), in 2D per thickness,
/// so one condensation serves every cell size, strength and fracture energy; it depends on Poisson's ratio,
/// the crack and the mesh only. Areas of crack faces being weight l^(dim-1), the power l^(dim-2) cancels from
/// every equation: forces are counted per thickness in 2D and per edge of the cell in 3D, N/m in both.
template<int dim> struct CondensedCell {
  Eigen::MatrixXd stiffness;  ///< S, dim n x dim n, symmetric positive definite
  Eigen::MatrixXd coupling;   ///< G, dim n x voigt_size
  VoigtMatrix<dim> uncracked; ///< C: stiffness of the cell with the crack held closed
  std::vector<CrackNode> nodes;
};

} // namespace spall
