#include "macro/output/quantile.h"

#include <bit>
#include <cstdint>
#include <limits>

namespace spall {
namespace {

constexpr std::uint64_t sign = std::uint64_t{1} << 63;

/// Maps a double to an integer so that the order is preserved.
std::uint64_t rank_of(double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  return bits & sign ? ~bits : bits | sign;
}
double value_of(std::uint64_t rank) { return std::bit_cast<double>(rank & sign ? rank & ~sign : ~rank); }

} // namespace

double weighted_quantile(const std::vector<double>& values, const std::vector<double>& weights, double reach,
                         const Ranks& ranks) {
  std::vector<std::uint64_t> order;
  order.reserve(values.size());
  for (const double value : values) order.push_back(rank_of(value));
  double all = 0;
  for (const double weight : weights) all += weight;
  if (!(ranks.sum(all) >= reach) || ranks.sum(static_cast<double>(values.size())) == 0)
    return std::numeric_limits<double>::quiet_NaN();
  std::uint64_t low = 0, high = std::numeric_limits<std::uint64_t>::max(); // the answer is in [low, high]
  while (low < high) {
    const std::uint64_t middle = low + (high - low) / 2;
    double below = 0;
    for (std::size_t i = 0; i < order.size(); ++i)
      if (order[i] <= middle) below += weights[i];
    if (ranks.sum(below) >= reach)
      high = middle;
    else
      low = middle + 1;
  }
  return value_of(low);
}

} // namespace spall
