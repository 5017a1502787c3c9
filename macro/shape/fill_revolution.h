#pragma once

#include "macro/points/ghosts.h"
#include "macro/points/points.h"
#include "macro/shape/revolution.h"

namespace spall {

/// Fills a body of revolution with points in layers about `spacing` thick, which begin and end at the kinks
/// (but for those nearer to another than a quarter of the spacing). Where it is hollow a layer has at least
/// `rings` rings through the wall; rings lie at the same parts of the way from the inner to the outer
/// surface, so that they follow an ogive, and their points are about `spacing` apart. The numbers of points
/// on a ring are multiples of four with equal gaps: none lies on the axis or on the planes x = 0 and y = 0.
/// With rotational symmetry a point stands for its ring. Every point is about the centre of its cell; volumes
/// and their first moment along z add up to those of the (part of the) body exactly. Sets what fill_cylinder
/// sets: the top layer has the high face, the lowest one the low face, the outermost rings the rim. A point's
/// spacing is the cube root of its cell, but not much less than the wanted one.
Points fill_revolution(const Sections& body, int rings, double spacing, const SymmetryPlanes& planes,
                       double density);

} // namespace spall
