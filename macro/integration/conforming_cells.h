#pragma once

#include "macro/points/ghosts.h"

#include <cstdint>
#include <vector>

namespace spall {

/// normal . x <= offset, with a unit normal.
struct HalfSpace {
  Vec3 normal;
  double offset;
};

/// Outline of a cylinder on the z axis as half-spaces: a prism of the same volume, symmetric about x = 0 and
/// y = 0.
std::vector<HalfSpace> cylinder_outline(double radius, double bottom, double height);

/// Smoothing cells that fill a body without gaps or overlaps (SCNI, Chen et al. 2001): the Voronoi cells of
/// its points, cut off at its outline. Neighbours share their faces, so that the smoothed gradients of a
/// function that vanishes at the surface add up to zero: the linear patch test is passed.
struct ConformingCells {
  struct Face {
    Vec3 centre; ///< centroid, relative to the point, m
    Vec3 area;   ///< outward normal times area, m^2
  };
  std::vector<std::uint32_t> start; ///< CSR offsets, one per owned point and the end
  std::vector<Face> face;
  std::vector<double> volume; ///< volume of each owned point's cell, m^3
};

/// Cells of a convex body in its initial configuration; images behind symmetry planes are respected.
/// @throws ComputationError if the points are so irregular that a face lies more than a spacing from its
/// point.
ConformingCells voronoi_cells(const Points& points, const SymmetryPlanes& planes,
                              const std::vector<HalfSpace>& outline);

/// The cells of some of the points.
ConformingCells part_of(const ConformingCells& cells, const Share& share);

/// Gives the points the volumes of the cells, and their mass at unchanged density.
void adopt_volumes(Points& points, const ConformingCells& cells);

} // namespace spall
