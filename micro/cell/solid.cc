// 3D cells: extruded plane cells, and the cube with a penny-shaped crack.

#include "micro/cell/mesh.h"
#include "micro/cell/penny.h"

namespace spall {
namespace {

/// Extrudes a plane cell along z.
CellComplex<3> extruded(const CellComplex<2>& plane, int layers) {
  CellComplex<3> solid;
  const auto size = static_cast<unsigned int>(plane.vertices.size());
  for (int k = 0; k <= layers; ++k)
    for (const auto& at : plane.vertices) solid.vertices.emplace_back(at[0], at[1], double(k) / layers);
  for (unsigned int k = 0; k < static_cast<unsigned int>(layers); ++k) {
    const unsigned int front = k * size, back = front + size;
    for (std::size_t i = 0; i < plane.cells.size(); ++i) {
      const auto& c = plane.cells[i];
      solid.cells.push_back({c[0] + front, c[1] + front, c[2] + front, c[3] + front, c[0] + back, c[1] + back,
                             c[2] + back, c[3] + back});
      if (!plane.materials.empty()) solid.materials.push_back(plane.materials[i]);
    }
    // The first direction of a face is z, the second one is along the line, so that their cross product
    // points to the upper side.
    for (const CrackFace<2>& face : plane.cracks)
      solid.cracks.push_back({.vertices = {face.vertices[0] + front, face.vertices[0] + back,
                                           face.vertices[1] + front, face.vertices[1] + back},
                              .line = face.line,
                              .open = face.open});
  }
  for (int i = 0; i < 2; ++i)
    for (int c = 0; c < 2; ++c) solid.periods[i][c] = plane.periods[i][c];
  solid.periods[2][2] = 1;
  return solid;
}

CellComplex<3> cell_complex(const PennyGrid& grid) {
  CellComplex<3> solid;
  const auto size = static_cast<unsigned int>(grid.vertices.size());
  for (const double y : grid.heights)
    for (const auto& at : grid.vertices) solid.vertices.emplace_back(at[0], y, at[1]);
  for (unsigned int j = 0; j < grid.heights.size(); ++j) {
    const unsigned int low = j * size, high = low + size;
    for (std::size_t i = 0; i < grid.quads.size(); ++i) {
      const auto& q = grid.quads[i];
      if (j + 1 < grid.heights.size())
        solid.cells.push_back({q[0] + low, q[1] + low, q[0] + high, q[1] + high, q[2] + low, q[3] + low,
                               q[2] + high, q[3] + high});
      if (grid.heights[j] == 0.5) // z first, then x: their cross product points upwards
        solid.cracks.push_back(
            {.vertices = {q[0] + low, q[2] + low, q[1] + low, q[3] + low}, .line = 0, .open = grid.open[i]});
    }
  }
  for (int i = 0; i < 3; ++i) solid.periods[i][i] = 1;
  return solid;
}

} // namespace

template<> CellComplex<2> cell_complex<2>(const CellGeometry& geometry, const MeshDensity& density) {
  return cell_complex(cell_grid(geometry, density));
}

template<> CellComplex<3> cell_complex<3>(const CellGeometry& geometry, const MeshDensity& density) {
  switch (geometry.shape) {
  case CrackShape::through:
    return extruded(cell_complex<2>(geometry, density), density.layers);
  case CrackShape::penny:
    break;
  }
  return cell_complex(penny_grid(geometry, density));
}

} // namespace spall
