#pragma once

#include "macro/points/ghosts.h"
#include "macro/points/points.h"

#include <functional>
#include <vector>

namespace spall {

/// A body of revolution about z, hollow or not.
struct Revolution {
  std::function<double(double)> outer, inner; ///< radii of the section at z, m; inner 0: solid there
  std::vector<double> kinks; ///< ascending: from end to end, and where the radii or their slopes jump, m
};

/// Fills it with points in layers about `spacing` thick, which begin and end at the kinks. Where it is hollow
/// a layer has at least `rings` rings through the wall; rings lie at the same parts of the way from the inner
/// to the outer surface, so that they follow an ogive, and their points are about `spacing` apart. The
/// numbers of points on a ring are multiples of four with equal gaps: none lies on the axis or on the planes
/// x = 0 and y = 0. With rotational symmetry a point stands for its ring. Every point is about the centre of
/// its cell; volumes and their first moment along z add up to those of the (part of the) body exactly. Sets
/// what fill_cylinder sets; a point's spacing is the cube root of its cell, but not much less than the wanted
/// one.
Points fill_revolution(const Revolution& body, int rings, double spacing, const SymmetryPlanes& planes,
                       double density);

} // namespace spall
