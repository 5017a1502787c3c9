#pragma once

#include "macro/points/points.h"

#include <cstdint>
#include <vector>

namespace spall {

/// The permutation that puts positions along a Hilbert curve (deal.II's), so that points near in space are
/// near in memory. result[k] is the old index of the k-th point.
std::vector<std::uint32_t> hilbert_order(const std::vector<Vec3>& positions);

} // namespace spall
