#pragma once

#include "macro/points/ghosts.h"

#include <cstdint>
#include <vector>

namespace spall {

/// Neighbours of the owned points in the present approximation, ghosts included: those of point i are
/// index[start[i] .. start[i + 1]).
struct NeighborLists {
  std::vector<std::uint32_t> start, index;
};

/// Indicators of hourglassing and instability: the parts of fields that alternate from point to point. In a
/// sound solution the fields are smooth and the indicators small. Root mean squares over the points, weighted
/// by volume.
struct HourglassIndicators {
  /// Plastic strain less the kernel-weighted mean of the neighbours.
  double plastic_saw_tooth = 0;
  /// Positions less the neighbours' linear map from the undeformed body, less what the neighbours show of the
  /// same (curvature), in spacings.
  double position_saw_tooth = 0;
  /// Volume of the cells between points (octants about each point, from the neighbours in each) over the
  /// integrated volume ratio: mean, less 1.
  double volume_mismatch = 0;
  /// Differences of volume between opposite octants less those at the neighbours: 0 for a smooth field, the
  /// amplitude for one that alternates from cell to cell; as a part of the volume.
  double volume_alternation = 0;
};

/// Neighbours count while they are neighbours in the undeformed body (within two spacings); points with fewer
/// than six of them (fragments) are left out. All ranks must call it together, and get the same values.
/// @param plastic_strain of the owned points
HourglassIndicators measure_hourglassing(const Points& points, const Ghosts& ghosts,
                                         const NeighborLists& lists,
                                         const std::vector<double>& plastic_strain);

} // namespace spall
