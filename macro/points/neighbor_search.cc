#include "macro/points/neighbor_search.h"

#include "macro/points/parallel.h"

#include <algorithm>
#include <cmath>

namespace spall {

void NeighborSearch::rebuild(const Points& points, double cell) {
  const std::size_t n = points.position.component[0].size();
  if (n == 0) { // one cell without a point
    *this = {};
    return;
  }
  Vec3 high;
  for (int c = 0; c < 3; ++c) {
    const auto [low, top] =
        std::minmax_element(points.position.component[c].begin(), points.position.component[c].end());
    origin[c] = *low;
    high[c] = *top;
  }
  // A grid with many more cells than points would cost memory and time for empty cells.
  const double limit = 16.0 * static_cast<double>(n) + 4096;
  for (;; cell *= 1.26) { // doubles the volume of a cell
    double cells = 1;
    for (int c = 0; c < 3; ++c) {
      count[c] = static_cast<int>(std::min(1e6, (high[c] - origin[c]) / cell)) + 1;
      cells *= count[c];
    }
    if (cells <= limit) break;
  }
  inverse_edge = 1 / cell;

  std::vector<std::uint32_t> cell_index(n);
  for_each_index((n + 4095) / 4096, [&](std::size_t chunk) {
    for (std::size_t i = chunk * 4096; i < std::min(n, (chunk + 1) * 4096); ++i) {
      const Vec3 x = points.position[i];
      cell_index[i] = (cell_of(x[2], 2) * count[1] + cell_of(x[1], 1)) * count[0] + cell_of(x[0], 0);
    }
  });
  start.assign(static_cast<std::size_t>(count[0]) * count[1] * count[2] + 1, 0);
  for (std::size_t i = 0; i < n; ++i) ++start[cell_index[i] + 1];
  for (std::size_t k = 1; k < start.size(); ++k) start[k] += start[k - 1];
  index.resize(n + padding);
  for (auto& component : sorted) component.resize(n + padding);
  std::vector<std::uint32_t> next(start.begin(), start.end() - 1);
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint32_t s = next[cell_index[i]]++;
    index[s] = static_cast<std::uint32_t>(i);
    for (int c = 0; c < 3; ++c) sorted[c][s] = points.position.component[c][i];
  }
}

} // namespace spall
