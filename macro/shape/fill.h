#pragma once

#include "macro/points/ghosts.h"
#include "macro/points/points.h"
#include "macro/shape/shape.h"

#include <cmath>
#include <limits>

namespace spall {

/// Where the points of a body are.
enum class Layout {
  polar,  ///< on concentric rings: the rim is a circle, cells near the axis are not squares
  lattice ///< on a Cartesian lattice: cells are bricks, the rim is a staircase
};

/// Where the outermost points of a body lie.
enum class Boundary {
  centred,   ///< half a spacing inside: every point is the centre of its cell
  on_surface ///< on the surface, with the part of a cell that is inside; of a lattice on the ends only
};

/// Random displacement of points from their regular places: breaks the lattice (cracks do not follow it), and
/// tests how a scheme bears irregular points.
struct Jitter {
  double amount = 0; ///< part of the way to the wall of the cell, 0 to 1; points on a surface stay on it
  int seed = 1;
};

/// Size of the cells against the distance from the axis: the fine spacing as far as the fine radius, then
/// every ring wider than the last by the growth, up to the coarse spacing.
struct Grading {
  double fine_spacing = std::numeric_limits<double>::quiet_NaN();   ///< m; NaN: not graded
  double fine_radius = std::numeric_limits<double>::quiet_NaN();    ///< m
  double coarse_spacing = std::numeric_limits<double>::quiet_NaN(); ///< m
  double growth = 1.15; ///< of a wave of 8 coarse spacings 0.1 % of the energy comes back with 1.1 and 1.15,
                        ///< 0.5 % with 1.2

  bool used() const { return std::isfinite(fine_spacing); }
};

/// How a body is filled with points. A cylinder: `rings` over the radius and `layers` over the height, or
/// graded. Another body of revolution: `layers` over the length, and at least `rings` through the wall where
/// it is hollow. A block or a closed surface: by its spacing.
struct Filling {
  int rings = 0, layers = 0;
  Boundary boundary = Boundary::centred;
  Layout layout = Layout::polar;
  Grading grading = {};
  Jitter jitter = {};
  double spacing =
      std::numeric_limits<double>::quiet_NaN(); ///< of the points of a block or closed surface, m
};

/// Fills a body with points, as the function of its kind below does, in the frame of its shape.
/// @param density kg/m^3
/// @throws std::invalid_argument for a shape without end, or one that lacks the symmetry
Points fill(const Shape& shape, const Filling& filling, const SymmetryPlanes& planes, double density);

/// Fills a cylinder with points, symmetric about x = 0 and y = 0 and none on the axis or on those planes. Of
/// the planes in `planes` only the positive side is filled; with rotational symmetry one point of each ring,
/// in the half plane y = 0. The points are Hilbert-ordered and know their position, volume, mass, spacing
/// (cube root of the cell: of a whole one for those that a surface cuts), surfaces. A jittered point keeps
/// the volume of its cell. The volumes add up to the (part of the) cylinder exactly.
///
/// Polar: rings of multiples of four points with equal gaps, stacked in layers. Graded: every ring has its
/// own number of points around and of layers, so that its cells are as nearly cubes as whole numbers allow;
/// layers of neighbouring rings need not meet, as the approximation asks for no mesh. All widths are then
/// changed by one factor, at most half a coarse spacing over the radius, to end at the rim.
///
/// Lattice: cells whose centre is inside. Those that the rim cuts, and what it leaves of cells whose centre
/// is outside, make partial volumes, the latter spread over the former in proportion.
Points fill_cylinder(const Cylinder& cylinder, const Filling& filling, const SymmetryPlanes& planes,
                     double density);

/// Fills a block with points on a lattice whose cells are about cubes of the spacing, even numbers of them
/// along x and y, so that the points are symmetric about x = 0 and y = 0 and none lies on those planes. All
/// sides are the rim. Otherwise as fill_cylinder.
Points fill_block(const Block& block, const Filling& filling, const SymmetryPlanes& planes, double density);

/// Fills a closed surface with points on the lattice that fill_block gives the box around it: those of the
/// cells whose centre is inside. Such a cell that the surface cuts has the part of its volume that is inside;
/// all these parts are scaled by one factor, so that the volumes add up to that of the surface exactly. A
/// cell without a neighbour has a surface on that side.
/// @param planes only the positive side of those is filled; the surface must be symmetric about them
/// @throws std::invalid_argument if the factor is above 2 or below 1/2: the cells are too coarse
Points fill_surface(const ClosedSurface& surface, const Filling& filling, const SymmetryPlanes& planes,
                    double density);

} // namespace spall
