#pragma once

#include "macro/points/points.h"
#include "shared/ranks.h"

namespace spall {

/// This rank's share of a number of points of a body: consecutive ones, so that points along a Hilbert curve
/// fall into compact parts, in order of the ranks. Parts begin at multiples of `granule` points and differ by
/// one granule at most; of few points the last ranks get none. With one rank all of them.
Share share_of(std::size_t points, const Ranks& ranks, std::size_t granule);

/// Those points.
Points part_of(Points points, const Share& share);

} // namespace spall
