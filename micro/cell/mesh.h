#pragma once

#include "micro/cell/geometry.h"

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>
#include <deal.II/grid/tria.h>

#include <array>
#include <vector>

namespace spall {

/// A face along which the solid may crack. Its upper side is left of the way from the first to the second
/// vertex (dim = 2), or where (v1 - v0) x (v2 - v0) points (dim = 3).
template<int dim> struct CrackFace {
  std::array<unsigned int, (1 << (dim - 1))> vertices{};
  int line = 0;      ///< number of the crack line; the faces of a line share a cohesive law
  bool open = false; ///< initial crack
};

/// The solid of one period before it is cut: cells that share their faces (conforming), and the faces along
/// which it may crack. Crack faces may meet, cross, end inside and lie on the border of the period, where one
/// of the two images is named. A crack that ends inside on both ends must be at least two faces long: the
/// vertices of its ends stay whole.
template<int dim> struct CellComplex {
  std::vector<dealii::Point<dim>> vertices;
  std::vector<std::array<unsigned int, (1 << dim)>> cells; ///< vertices as in the unit cell of deal.II
  std::vector<unsigned int> materials;                     ///< per cell; empty: all 0
  std::vector<CrackFace<dim>> cracks;
  std::array<dealii::Tensor<1, dim>, dim> periods{}; ///< of the lattice that repeats the solid
};

/// Two sets of boundary faces that coincide, across a crack or (after a shift) across a period.
template<int dim> struct Seam {
  dealii::types::boundary_id lower = 0, upper = 0; ///< the normal of the crack points out of `lower`
  dealii::Tensor<1, dim> shift; ///< from the lower to the upper face; 0 except at the border of the period
  bool crack = false;           ///< false: only a border of the period
  bool border = false;
  int line = 0;      ///< of a crack
  bool open = false; ///< of a crack
};

/// Fills an empty triangulation. Each crack face becomes two boundary faces; a vertex gets as many copies as
/// the crack faces part the cells around it, whatever way they meet there. Seams of cracks come first, in the
/// order of complex.cracks, then those of the border.
/// @param refinements each cell is split into 2^dim so many times
/// @throws std::invalid_argument if a crack face is not a face, its vertices are whole, or border faces have
/// no image.
template<int dim>
std::vector<Seam<dim>> make_split_mesh(const CellComplex<dim>& complex, unsigned int refinements,
                                       dealii::Triangulation<dim>& mesh);

/// The unit cell of a grid with its crack lines.
CellComplex<2> cell_complex(const CellGrid& grid);

/// The unit cell with the cracks of a geometry; in 3D of its shape.
template<int dim> CellComplex<dim> cell_complex(const CellGeometry& geometry, const MeshDensity& density);
template<> CellComplex<2> cell_complex<2>(const CellGeometry& geometry, const MeshDensity& density);
template<> CellComplex<3> cell_complex<3>(const CellGeometry& geometry, const MeshDensity& density);

} // namespace spall
