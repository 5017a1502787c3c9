#include "macro/points/order.h"

#include <deal.II/base/point.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <numeric>

namespace spall {

std::vector<std::uint32_t> hilbert_order(const std::vector<Vec3>& positions) {
  std::vector<std::uint32_t> order(positions.size());
  std::iota(order.begin(), order.end(), 0u);
  if (positions.size() < 2) return order;
  std::vector<dealii::Point<3>> points;
  for (const Vec3& x : positions) points.emplace_back(x[0], x[1], x[2]);
  const auto keys = dealii::Utilities::inverse_Hilbert_space_filling_curve(points, 20);
  std::stable_sort(order.begin(), order.end(),
                   [&keys](std::uint32_t a, std::uint32_t b) { return keys[a] < keys[b]; });
  return order;
}

} // namespace spall
