#pragma once

#include "macro/points/points.h"

#include <cstdint>
#include <vector>

namespace spall {

/// Finds the points inside a box. Points are sorted into cubic cells of about one spacing; cells
/// along x are contiguous, so that a query reads one run of memory per (y, z) row.
class NeighborSearch {
public:
  /// Sorts all points, ghosts included, into cells. There may be none.
  /// @param cell edge of the cells, m; it is increased when fragments have flown so far apart that the grid
  /// would hold more than a few cells per point
  void rebuild(const Points& points, double cell);

  /// Calls visit(index, dx, dy, dz) for every point in the box centre +- half, with its offset from the
  /// centre, in an order that depends on the positions only.
  template<class Visit> void for_each_in_box(const Vec3& centre, const Vec3& half, const Visit& visit) const {
    std::array<int, 3> low, high;
    for (int c = 0; c < 3; ++c) {
      low[c] = cell_of(centre[c] - half[c], c);
      high[c] = cell_of(centre[c] + half[c], c);
    }
    for (int k = low[2]; k <= high[2]; ++k)
      for (int j = low[1]; j <= high[1]; ++j) {
        const std::size_t row = (static_cast<std::size_t>(k) * count[1] + j) * count[0];
        const std::uint32_t end = start[row + high[0] + 1];
        for (std::uint32_t s = start[row + low[0]]; s < end; ++s) {
          const double dx = sorted[s][0] - centre[0], dy = sorted[s][1] - centre[1],
                       dz = sorted[s][2] - centre[2];
          visit(index[s], dx, dy, dz);
        }
      }
  }

private:
  int cell_of(double x, int c) const {
    const double cell = (x - origin[c]) * inverse_edge;
    return cell <= 0 ? 0 : cell >= count[c] - 1 ? count[c] - 1 : static_cast<int>(cell);
  }
  Vec3 origin{};
  double inverse_edge = 1;
  std::array<int, 3> count{1, 1, 1};
  std::vector<std::uint32_t> start = {0, 0}, index; ///< CSR: cell -> points
  std::vector<Vec3> sorted;                         ///< positions in cell order
};

} // namespace spall
