#pragma once

#include "macro/points/ghosts.h"

#include <cstdint>
#include <vector>

namespace spall {

/// Neighbours of the owned points as they are in the rows, ghosts included: index[start[i] .. start[i + 1]).
struct NeighborLists {
  std::vector<std::uint32_t> start, index;
};

/// What an unstable or hourglassing solution shows between neighbours: high-frequency parts of fields that
/// are smooth in a sound one. Root mean squares over the points, weighted by volume.
struct Roughness {
  /// Plastic strain against the kernel-weighted mean of the neighbours.
  double plastic_saw_tooth = 0;
  /// Positions against the neighbours' linear map from the undeformed body, less what the neighbours show of
  /// the same (curvature), in spacings.
  double position_saw_tooth = 0;
  /// Volume of the cells between points (octants about each point, from the neighbours in each) against the
  /// integrated volume ratio: mean, less 1.
  double volume_mismatch = 0;
  /// How far the volumes of opposite octants differ beyond what they differ at the neighbours: 0 for a smooth
  /// field, the amplitude for one that alternates from cell to cell; as a part of the volume.
  double volume_alternation = 0;
};

/// Neighbours count while they are neighbours in the undeformed body (within two spacings); points with fewer
/// than six of them (fragments) are left out. `plastic_strain` over the owned points.
Roughness measure_roughness(const Points& points, const Ghosts& ghosts, const NeighborLists& lists,
                            const std::vector<double>& plastic_strain);

} // namespace spall
