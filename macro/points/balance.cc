#include "macro/points/balance.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <numeric>

namespace spall {

double imbalance_of(const std::vector<double>& costs, const std::vector<std::uint64_t>& cuts) {
  const double mean = std::accumulate(costs.begin(), costs.end(), 0.0) / static_cast<double>(cuts.size() - 1);
  double largest = 0;
  for (std::size_t r = 0; r + 1 < cuts.size(); ++r)
    largest =
        std::max(largest, std::accumulate(costs.begin() + static_cast<std::ptrdiff_t>(cuts[r]),
                                          costs.begin() + static_cast<std::ptrdiff_t>(cuts[r + 1]), 0.0));
  return mean > 0 ? largest / mean - 1 : 0;
}

std::vector<std::uint64_t> balanced_cuts(const std::vector<double>& costs, std::size_t ranks) {
  std::vector<double> before = {0}; // cumulative cost before each block
  for (const double cost : costs) before.push_back(before.back() + cost);
  std::vector<std::uint64_t> cuts = {0};
  for (std::size_t r = 1; r < ranks; ++r) {
    const double wanted = before.back() * static_cast<double>(r) / static_cast<double>(ranks);
    auto at = std::lower_bound(before.begin(), before.end(), wanted);
    if (at != before.begin() && wanted - *(at - 1) < *at - wanted) --at;
    cuts.push_back(std::max(cuts.back(), static_cast<std::uint64_t>(at - before.begin())));
  }
  cuts.push_back(costs.size());
  return cuts;
}

double CostTimer::now() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

} // namespace spall
