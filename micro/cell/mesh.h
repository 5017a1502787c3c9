#pragma once

#include "micro/cell/geometry.h"

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>
#include <deal.II/grid/tria.h>

#include <array>
#include <vector>

namespace spall {

/// A face along which the solid may crack. Its upper side lies to the left of the direction from the first to
/// the second vertex (dim = 2), or in the direction of (v1 - v0) x (v2 - v0) (dim = 3).
template<int dim> struct CrackFace {
  std::array<unsigned int, (1 << (dim - 1))> vertices{};
  int line = 0;      ///< number of the crack line; the faces of a line share a cohesive law
  bool open = false; ///< whether the face belongs to an initial crack
};

/// One period of the solid before it is split along the cracks: a conforming mesh and the faces along which
/// it may crack. Crack faces may meet, cross, end inside the solid and lie on the border of the period; there
/// only one of the two periodic images is listed. A crack with both ends inside the solid must be at least
/// two faces long, because the vertices at its ends are not split.
template<int dim> struct CellComplex {
  std::vector<dealii::Point<dim>> vertices;
  /// Vertex numbers of each cell, in deal.II's order.
  std::vector<std::array<unsigned int, (1 << dim)>> cells;
  std::vector<unsigned int> materials; ///< material number of each cell; empty: all are 0
  std::vector<CrackFace<dim>> cracks;
  std::array<dealii::Tensor<1, dim>, dim> periods{}; ///< lattice vectors of the periodic solid
};

/// Two boundary faces that coincide: the two faces of a crack, or (after a shift) periodic images.
template<int dim> struct Seam {
  /// Boundary ids of the two faces; the normal of the crack points out of `lower`.
  dealii::types::boundary_id lower = 0, upper = 0;
  /// Shift from the lower to the upper face; 0 except at the border of the period.
  dealii::Tensor<1, dim> shift;
  bool crack = false;  ///< whether the seam is a crack; false: it only joins periodic images
  bool border = false; ///< whether the seam lies on the border of the period
  int line = 0;        ///< number of the crack line, for a crack
  bool open = false;   ///< whether it is an initial crack, for a crack
};

/// Fills an empty triangulation with the solid split along its cracks. Each crack face becomes two boundary
/// faces. A vertex gets one copy for each group of cells around it that the crack faces separate, however
/// many crack faces meet there. The result lists the seams of cracks first, in the order of complex.cracks,
/// then those of the border.
/// @param refinements number of times that each cell is divided into 2^dim cells
/// @throws std::invalid_argument if a crack face is not a face of the mesh, if none of its vertices is split,
/// or if a border face has no periodic image.
template<int dim>
std::vector<Seam<dim>> make_split_mesh(const CellComplex<dim>& complex, unsigned int refinements,
                                       dealii::Triangulation<dim>& mesh);

/// The mesh and crack faces of the unit cell, from a grid.
CellComplex<2> cell_complex(const CellGrid& grid);

/// The mesh and crack faces of the unit cell, from a geometry; in 3D the cracks have the geometry's shape.
template<int dim> CellComplex<dim> cell_complex(const CellGeometry& geometry, const MeshDensity& density);
template<> CellComplex<2> cell_complex<2>(const CellGeometry& geometry, const MeshDensity& density);
template<> CellComplex<3> cell_complex<3>(const CellGeometry& geometry, const MeshDensity& density);

} // namespace spall
