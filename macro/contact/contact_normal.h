#pragma once

#include "macro/approximation/reproducing_kernel.h"
#include "macro/contact/contact_inputs.h"
#include "macro/contact/near_points.h"

namespace spall {

/// Radius of the clouds of points that the contact uses, in the larger spacing of the two bodies.
inline constexpr double contact_support = 2;

/// Outward unit normal of the other body at x: from there towards `own`. Level set (paper Eqs. 17-19): the
/// gradient at x of the joint reproducing-kernel approximation of +1 on the own points and -1 on the other's.
/// Pair direction: kernel-weighted mean of the directions from the other body's points to x. Zero if there
/// is no such direction.
/// @param radius of the cloud, m
Vec3 contact_normal(const Vec3& x, const NearPoints& own, const NearPoints& other, double radius,
                    ContactNormal kind, Cloud<double>& scratch);

/// A direction out of the other body, from which the search for its surface starts: the gradient of the same
/// level set with plain kernels, each point with the volume of its cell. At the rim of a body, where the
/// joint approximation bends the most, it is off by 10 degrees. Zero if there is no such direction.
Vec3 separating_direction(const Vec3& x, const NearPoints& own, const NearPoints& other, double radius);

} // namespace spall
