#pragma once

#include "macro/points/points.h"
#include "shared/ranks.h"

namespace spall {

/// This rank's share of a body's points. The shares are consecutive, so that points along a Hilbert curve
/// fall into compact parts. They begin at multiples of `granule` points and differ by one granule at most; if
/// there are few points, the last ranks get none. A single rank has all of them.
Share share_of(std::size_t points, const Ranks& ranks, std::size_t granule);

/// The points of a share, without the memory of the others.
Points part_of(Points points, const Share& share);

} // namespace spall
