#pragma once

#include "macro/shape/mass_properties.h"
#include "macro/shape/triangle_tree.h"

namespace spall {

/// Mass properties of the homogeneous body inside a closed surface, by the divergence theorem: every triangle
/// makes a tetrahedron with one place, of signed volume V, whose integrals of x_i x_j are
/// V / 20 (sum_k a_ki a_kj + s_i s_j) with the corners a_k and their sum s, as seen from that place. Their
/// round-off is least if the place is amid the body.
MassProperties solid_inside(const Triangles& surface, const Vec3& amid);

} // namespace spall
