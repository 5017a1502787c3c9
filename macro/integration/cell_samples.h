#pragma once

#include "macro/integration/integration.h"
#include "macro/points/tensor.h"

namespace spall {

/// Sample points of a nodal cell in units of its edge, from the node; all represent equal volumes.
struct CellSamples {
  int count = 0;
  std::array<Vec3, 8> offset{};
};

/// Sample points of M-SNNI, M-SCNI and sub-point integration. Of 8 there is one in each octant; of 4, in
/// every other octant (a tetrahedron); of 6, on both sides along the axes.
///
/// M-SNNI takes the centroids of its subcells (paper Eq. 11): octants, or the six pyramids below the faces.
/// Sub-points carry the cell's stress and are placed so that their second moment is that of the cube, h^2 /
/// 12 per axis: the mean is then exact for quadratic strains with 4 and 6, for cubic ones with 8 (Gauss).
///
/// Around an axis there are four in the half plane, whatever number is asked for: the quarters of the cell,
/// or the sub-points half an edge off the node along both directions.
inline CellSamples cell_samples(const IntegrationInputs& inputs) {
  const bool subpoints = inputs.scheme == Scheme::subpoint;
  CellSamples s;
  if (inputs.axisymmetric) {
    if (subpoints) {
      for (const double d : {0.5, -0.5}) s.offset[s.count++] = {d, 0, 0}, s.offset[s.count++] = {0, 0, d};
      return s;
    }
    for (const double x : {0.25, -0.25})
      for (const double z : {0.25, -0.25}) s.offset[s.count++] = {x, 0, z};
    return s;
  }
  if (inputs.subcells == 6) {
    const double d = subpoints ? 0.5 : 0.375;
    for (int k = 0; k < 3; ++k)
      for (const double side : {d, -d}) s.offset[s.count++][k] = side;
    return s;
  }
  const double d = subpoints ? 0.28867513459481287 : 0.25; // 1 / (2 sqrt 3)
  for (int octant = 0; octant < 8; ++octant) {
    const int x = octant & 1, y = octant >> 1 & 1, z = octant >> 2;
    if (inputs.subcells == 4 && (x ^ y ^ z) != 0) continue;
    s.offset[s.count++] = {x ? d : -d, y ? d : -d, z ? d : -d};
  }
  return s;
}

} // namespace spall
