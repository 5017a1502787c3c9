#pragma once

#include <Eigen/Core>

#include <array>
#include <vector>

namespace spall {

template<int dim> inline constexpr int voigt_size = dim*(dim + 1) / 2;
/// Macroscopic strain or stress: xx, yy, xy in plane strain; xx, yy, zz, xy, yz, xz in 3D, the order that the
/// macroscopic program uses too. Shear strains are engineering strains (2 e_xy).
template<int dim> using Voigt = Eigen::Matrix<double, voigt_size<dim>, 1>;
template<int dim> using VoigtMatrix = Eigen::Matrix<double, voigt_size<dim>, voigt_size<dim>>;
/// Returns row and column in the tensor of the i-th component of a Voigt<dim>.
template<int dim> constexpr std::array<int, 2> tensor_index(int i) {
  if (i < dim) return {i, i};
  constexpr std::array<std::array<int, 2>, 3> shear = {{{0, 1}, {1, 2}, {0, 2}}};
  return shear[i - dim];
}

/// A pair of nodes that face each other across a crack.
struct CrackNode {
  std::array<double, 3> position{}; ///< position in the unit cell; z is 0 in 2D
  /// Length (2D) or area (3D) of crack that belongs to the node, in the unit cell (lumped quadrature).
  double weight = 0;
  /// Whether the node is on an initial crack, which transmits contact pressure only.
  bool initially_open = false;
  int line = 0; ///< number of the crack line that the node lies on
};

/// The bulk of the cell statically condensed onto its cracks: a quadratic form in the openings w (dim per
/// node: normal, then tangential) and the macroscopic strain e, for edge 1 and Young's modulus 1. With the
/// real E and l the elastic energy is
///   E l^(dim-2) (w.S w / 2 - l w.G e + l^2 e.C e / 2), in 2D per thickness,
/// so one condensation serves every cell size, strength and fracture energy; it depends on Poisson's ratio,
/// the crack and the mesh only. As the areas of crack faces are weight l^(dim-1), the power l^(dim-2) cancels
/// from every equation: forces are given per thickness in 2D and per edge length of the cell in 3D, N/m in
/// both.
template<int dim> struct CondensedCell {
  Eigen::MatrixXd stiffness;  ///< stiffness S of the openings (Schur complement), dim n x dim n, symmetric
                              ///< positive definite
  Eigen::MatrixXd coupling;   ///< coupling G of openings and macroscopic strain, dim n x voigt_size
  VoigtMatrix<dim> uncracked; ///< stiffness C of the cell with closed cracks
  std::vector<CrackNode> nodes;
};

} // namespace spall
