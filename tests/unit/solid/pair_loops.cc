// The loops over the neighbours of a point.

#include "macro/solid/pair_loops.h"

#include <gtest/gtest.h>

#include <random>

namespace spall::test {
namespace {

/// A point with 11 neighbours, which has random gradients, and their velocities.
template<class T> struct Neighbourhood {
  static constexpr std::uint32_t pairs = 11;
  GradientOperators<T> operators;
  std::vector<Lanes<T>> velocity;
  std::mt19937 engine{1};
  std::uniform_real_distribution<T> number{-1, 1};

  explicit Neighbourhood(int width) {
    operators.layout = {OperatorUse::moments, width, width};
    operators.start = {0, pairs};
    const std::size_t records = width == 1 ? pairs : 3 * pairs, slack = GradientOperators<T>::slack;
    operators.record.resize(records + slack / sizeof(Lanes<T>));
    operators.wide.resize(records + slack / sizeof(Lanes<T, 8>));
    for (std::uint32_t p = 0; p < pairs; ++p) {
      operators.column.push_back(static_cast<std::uint16_t>((7 * p) % pairs));
      velocity.push_back(Lanes<T>{number(engine), number(engine), number(engine), 0});
      for (int c = 0; c < 3; ++c)
        for (int m = 0; m < width; ++m) operators.add_to_entry(p, c, m, number(engine));
    }
  }
};

template<int L, class T> void expect_sums_over_the_pairs() {
  Neighbourhood<T> around(L);
  const auto& operators = around.operators;
  constexpr std::uint32_t pairs = Neighbourhood<T>::pairs;
  const double tolerance = 50 * std::numeric_limits<T>::epsilon();
  const MatLanes<L> rate =
      convert_lanes<L, double, T>(gather_rates<L>(operators, 0, pairs, around.velocity.data()));
  MatLanes<L> stress{};
  for (auto& entry : stress)
    for (int m = 0; m < L; ++m) set_lane<L, double>(entry, m, around.number(around.engine));
  std::vector<Lanes<T>> force(pairs, Lanes<T>{1, 2, 3, 0});
  scatter_forces<L>(operators, 0, pairs, convert_lanes<L, T, double>(stress), force.data());
  for (int m = 0; m < L; ++m)
    for (int c = 0; c < 3; ++c)
      for (int d = 0; d < 3; ++d) {
        double sum = 0;
        for (std::uint32_t p = 0; p < pairs; ++p)
          sum += around.velocity[operators.column[p]][c] * operators.entry(p, d, m);
        EXPECT_NEAR((get_lane<L, double>(rate(c, d), m)), sum, tolerance);
      }
  for (std::uint32_t p = 0; p < pairs; ++p)
    for (int c = 0; c < 3; ++c) {
      double sum = c + 1; // is added to
      for (int d = 0; d < 3; ++d)
        for (int m = 0; m < L; ++m) sum += operators.entry(p, d, m) * get_lane<L, double>(stress(d, c), m);
      EXPECT_NEAR(force[operators.column[p]][c], sum, tolerance);
    }
}

TEST(PairLoops, AddUpTheNeighboursOfEveryOperator) {
  expect_sums_over_the_pairs<1, float>();
  expect_sums_over_the_pairs<4, float>();
  expect_sums_over_the_pairs<8, float>();
  expect_sums_over_the_pairs<1, double>();
  expect_sums_over_the_pairs<4, double>();
  expect_sums_over_the_pairs<8, double>();
}

} // namespace
} // namespace spall::test
