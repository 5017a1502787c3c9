#pragma once

#include "macro/points/points.h"

#include <cstdint>
#include <vector>

namespace spall {

/// Finds the points inside a box. Points are sorted into cubic cells of about one spacing; cells
/// along x are contiguous, so that a query reads one run of memory per (y, z) row.
class NeighborSearch {
public:
  static constexpr std::size_t padding = 8;

  /// Sorts all points, ghosts included, into cells. There may be none.
  /// @param cell edge of the cells, m; it is increased when fragments have flown so far apart that the grid
  /// would hold more than a few cells per point
  void rebuild(const Points& points, double cell);

  /// Points that are stored one after the other. Behind the last one `padding` more values may be read.
  struct Run {
    std::array<const double*, 3> position; ///< x, y and z, m
    const std::uint32_t* index;
    std::size_t count;
  };

  /// Calls visit(run) for runs that hold all points in the box centre +- half, and a few outside, each point
  /// once, in an order that depends on the positions only.
  template<class Visit> void for_each_run(const Vec3& centre, const Vec3& half, const Visit& visit) const {
    std::array<int, 3> low, high;
    for (int c = 0; c < 3; ++c) {
      low[c] = cell_of(centre[c] - half[c], c);
      high[c] = cell_of(centre[c] + half[c], c);
    }
    for (int k = low[2]; k <= high[2]; ++k)
      for (int j = low[1]; j <= high[1]; ++j) {
        const std::size_t row = (static_cast<std::size_t>(k) * count[1] + j) * count[0];
        const std::uint32_t first = start[row + low[0]], end = start[row + high[0] + 1];
        if (first == end) continue;
        visit(Run{{sorted[0].data() + first, sorted[1].data() + first, sorted[2].data() + first},
                  index.data() + first,
                  end - first});
      }
  }

  /// Calls visit(index, dx, dy, dz) for these points, with their offsets from the centre.
  template<class Visit> void for_each_in_box(const Vec3& centre, const Vec3& half, const Visit& visit) const {
    for_each_run(centre, half, [&](const Run& run) {
      for (std::size_t s = 0; s < run.count; ++s)
        visit(run.index[s], run.position[0][s] - centre[0], run.position[1][s] - centre[1],
              run.position[2][s] - centre[2]);
    });
  }

private:
  int cell_of(double x, int c) const {
    const double cell = (x - origin[c]) * inverse_edge;
    return cell <= 0 ? 0 : cell >= count[c] - 1 ? count[c] - 1 : static_cast<int>(cell);
  }
  Vec3 origin{};
  double inverse_edge = 1;
  std::array<int, 3> count{1, 1, 1};
  std::vector<std::uint32_t> start = {0, 0}, index; ///< CSR: cell -> points; `index` is padded
  std::array<std::vector<double>, 3> sorted;        ///< positions in cell order, padded
};

} // namespace spall
