#include "macro/solid/force_reduction.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <random>

namespace spall::test {
namespace {

/// Random contributions of many blocks to many points.
template<class T> struct Contributions {
  std::vector<std::vector<std::uint32_t>> stencils;
  std::vector<std::vector<Lanes<T>>> forces;
  std::vector<const std::vector<std::uint32_t>*> stencil_of;
  std::vector<const Lanes<T>*> forces_of;

  Contributions(std::size_t blocks, std::size_t points, bool whole_numbers) {
    std::mt19937 engine(1);
    std::uniform_real_distribution<double> value(-1, 1);
    std::uniform_int_distribution<std::uint32_t> index(0, static_cast<std::uint32_t>(points - 1));
    stencils.resize(blocks), forces.resize(blocks);
    const auto number = [&] { return T(whole_numbers ? std::round(100 * value(engine)) : value(engine)); };
    for (std::size_t b = 0; b < blocks; ++b) {
      for (int n = 0; n < 300; ++n)
        stencils[b].push_back(index(engine) / 2 * 2); // points of odd numbers are in no stencil
      std::sort(stencils[b].begin(), stencils[b].end());
      stencils[b].erase(std::unique(stencils[b].begin(), stencils[b].end()), stencils[b].end());
      for (std::size_t e = 0; e < stencils[b].size(); ++e)
        forces[b].push_back(Lanes<T>{number(), number(), number(), 7});
      stencil_of.push_back(&stencils[b]), forces_of.push_back(forces[b].data());
    }
  }
};

constexpr std::size_t blocks = 20, count = 1000, block_size = 64;

template<class T> Points sum(const Contributions<T>& c) {
  Points points;
  points.resize(count);
  for (std::size_t i = 0; i < count; ++i)
    points.force.set(i, {1e9, 1e9, 1e9}); // old values must be overwritten
  ForceReduction reduction;
  reduction.rebuild(c.stencil_of, count, block_size);
  reduction.sum<T>(c.stencil_of, c.forces_of, points);
  return points;
}

TEST(ForceReduction, IsThePlainSum) {
  const Contributions<double> c(blocks, count, true); // integers add up without round-off
  std::vector<Vec3> expected(count);
  for (std::size_t b = 0; b < blocks; ++b)
    for (std::size_t e = 0; e < c.stencils[b].size(); ++e)
      for (int k = 0; k < 3; ++k) expected[c.stencils[b][e]][k] += c.forces[b][e][k];
  const Points points = sum(c);
  for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(points.force[i], expected[i]) << i;
  for (std::size_t i = 1; i < count; i += 2) EXPECT_EQ(points.force[i], Vec3{});
}

TEST(ForceReduction, DoesNotDependOnTheNumberOfThreads) {
  const Contributions<float> c(blocks, count, false);
  const Points one = [&] {
    const tbb::global_control single(tbb::global_control::max_allowed_parallelism, 1);
    return sum(c);
  }();
  for (int repeat = 0; repeat < 20; ++repeat) {
    const tbb::global_control several(tbb::global_control::max_allowed_parallelism, 4);
    const Points many = sum(c);
    for (int k = 0; k < 3; ++k) ASSERT_EQ(one.force.component[k], many.force.component[k]);
  }
}

TEST(ForceReduction, RebuildingRemovesThePreviousBlocks) {
  const Contributions<double> first(blocks, count, true), second(3, count / 2, true);
  Points points;
  points.resize(count);
  ForceReduction reduction;
  reduction.rebuild(first.stencil_of, count, block_size);
  reduction.sum<double>(first.stencil_of, first.forces_of, points);
  reduction.rebuild(second.stencil_of, count, block_size);
  reduction.sum<double>(second.stencil_of, second.forces_of, points);
  const Points fresh = sum(second);
  for (int k = 0; k < 3; ++k) EXPECT_EQ(points.force.component[k], fresh.force.component[k]);
}

} // namespace
} // namespace spall::test
