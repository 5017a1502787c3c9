#include "macro/points/balance.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace spall::test {
namespace {

using Cuts = std::vector<std::uint64_t>;

TEST(Balance, EqualCostsAreDistributedEqually) {
  const std::vector<double> costs(12, 0.5);
  const Cuts cuts = balanced_cuts(costs, 4);
  EXPECT_EQ(cuts, (Cuts{0, 3, 6, 9, 12}));
  EXPECT_NEAR(imbalance_of(costs, cuts), 0, 1e-15);
  EXPECT_NEAR(imbalance_of(costs, {0, 6, 8, 10, 12}), 1, 1e-15); // the largest cost is twice the mean
}

TEST(Balance, NoRankExceedsItsPartByMoreThanAPiece) {
  std::vector<double> costs;
  for (int k = 0; k < 200; ++k) costs.push_back(1 + (k * 37 % 101) * (k < 60 ? 0.2 : 0.01));
  double all = 0;
  for (const double cost : costs) all += cost;
  const double largest = *std::max_element(costs.begin(), costs.end());
  for (const std::size_t ranks : {2, 3, 7, 16}) {
    const double mean = all / static_cast<double>(ranks);
    EXPECT_LE(imbalance_of(costs, balanced_cuts(costs, ranks)), largest / mean);
  }
}

TEST(Balance, FewPiecesLeaveRanksWithoutAny) {
  const Cuts cuts = balanced_cuts({3, 1}, 4);
  EXPECT_EQ(cuts.front(), 0u);
  EXPECT_EQ(cuts.back(), 2u);
  EXPECT_TRUE(std::is_sorted(cuts.begin(), cuts.end()));
  EXPECT_EQ(balanced_cuts({}, 3), (Cuts{0, 0, 0, 0}));
  EXPECT_EQ(imbalance_of({}, {0, 0, 0, 0}), 0);
}

} // namespace
} // namespace spall::test
