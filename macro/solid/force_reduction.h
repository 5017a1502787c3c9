#pragma once

#include "macro/points/lanes.h"
#include "macro/points/points.h"

#include <cstdint>
#include <vector>

namespace spall {

/// Sums the forces of blocks on their stencil points. Every point adds its contributions in the order of the
/// blocks, so the sum does not depend on the number of threads.
class ForceReduction {
public:
  /// Finds out which blocks add to which points.
  /// @param stencils of the blocks: ascending global indices of the points that a block adds to
  /// @param count points with ghosts
  void rebuild(const std::vector<const std::vector<std::uint32_t>*>& stencils, std::size_t count,
               std::size_t block_size);
  /// Writes the sums into points.force, N.
  /// @param contributions of the blocks: one force (x, y, z, unused) per entry of their stencils; null: none
  template<class T>
  void sum(const std::vector<const std::vector<std::uint32_t>*>& stencils,
           const std::vector<const Lanes<T>*>& contributions, Points& points) const;
  std::size_t memory_bytes() const {
    std::size_t bytes = 0;
    for (const auto& list : incoming) bytes += sizeof(list) + sizeof(Segment) * list.capacity();
    return bytes;
  }

private:
  struct Segment {
    std::uint32_t source, first, last; ///< entries [first, last) of block `source`
  };
  std::vector<std::vector<Segment>> incoming; ///< segments for each destination range of block_size points
  std::size_t size = 0, range = 1;
};

} // namespace spall
