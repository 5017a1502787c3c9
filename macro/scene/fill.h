#pragma once

#include "macro/points/ghosts.h"
#include "macro/points/points.h"

namespace spall {

/// A right circular cylinder on the z axis, from z = bottom to bottom + height.
struct Cylinder {
  double radius = 0, height = 0, bottom = 0; ///< m
};

/// Where the outermost points of a body lie.
enum class Boundary {
  centred,   ///< half a spacing inside: every point is the centre of its cell
  on_surface ///< on the surface, with the part of a cell that is inside
};

/// Random displacement of points from their regular places: breaks the lattice (cracks do not follow it), and
/// tests how a scheme bears irregular points.
struct Jitter {
  double amount = 0; ///< part of the way to the wall of the cell, 0 to 1; points on a surface stay on it
  int seed = 1;
};

/// Fills a cylinder with points on concentric rings, stacked in layers: `rings` over the radius, `layers`
/// over the height. The numbers of points on a ring are multiples of four with equal gaps, so that points are
/// symmetric about x = 0 and y = 0 and none lies on the axis or on those planes. Of the planes in `planes`
/// only the positive side is filled; with rotational symmetry one
/// point of each ring, in the half plane y = 0. Sets position, initial position, volume, mass and spacing
/// (cube root of the mean cell), Hilbert-ordered. A jittered point keeps the volume of its cell. The volumes
/// add up to the (part of the) cylinder exactly.
Points fill_cylinder(const Cylinder& cylinder, int rings, int layers, Boundary boundary,
                     const SymmetryPlanes& planes, double density, const Jitter& jitter = {});

} // namespace spall
