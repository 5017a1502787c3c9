#include "macro/integration/gradient_operators.h"

#include "macro/points/ghosts.h"
#include "tests/unit/points/clouds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

namespace spall::test {
namespace {

constexpr double spacing = 0.01;
/// A scheme with its choices.
struct Case {
  std::string name;
  IntegrationInputs integration;
  ApproximationInputs approximation{};
};
void PrintTo(const Case& c, std::ostream* stream) { *stream << c.name; }

const Case nsni{"NSNI", {.scheme = Scheme::nsni}};
const std::vector<Case> schemes = {
    {"DNI", {.scheme = Scheme::dni}},
    {"SNNI", {.scheme = Scheme::snni}},
    nsni,
    {"M_SNNI_4", {.scheme = Scheme::m_snni, .subcells = 4}},
    {"M_SNNI_6", {.scheme = Scheme::m_snni, .subcells = 6}},
    {"M_SNNI_8", {.scheme = Scheme::m_snni, .subcells = 8}},
    {"SUBPOINT_4", {.scheme = Scheme::subpoint, .subcells = 4}},
    {"SUBPOINT_6", {.scheme = Scheme::subpoint, .subcells = 6}},
    {"SUBPOINT_8", {.scheme = Scheme::subpoint, .subcells = 8}},
};

template<class T>
GradientOperators<T> operators_of(const Points& points, const Case& c, std::size_t begin, std::size_t end) {
  NeighborSearch search;
  search.rebuild(points, spacing);
  std::vector<Support> supports;
  for (std::size_t i = begin; i < end; ++i)
    supports.push_back(make_support(points.deformation(i), points.spacing[i], c.approximation.support));
  GradientOperators<T> operators;
  operators.begin = begin, operators.end = end;
  OperatorScratch<T> scratch;
  EXPECT_EQ(build_gradient_operators(operators,
                                     {.points = points,
                                      .search = search,
                                      .supports = supports,
                                      .approximation = c.approximation,
                                      .integration = c.integration},
                                     scratch),
            "");
  return operators;
}

/// Returns component d of operator m in the record of pair p.
template<class T> double entry(const GradientOperators<T>& operators, std::uint32_t p, int d, int m) {
  const int width = operators.layout.width;
  if (width == 1) return m == 0 ? static_cast<double>(operators.record[p][d]) : 0;
  if (m >= width) return 0;
  return static_cast<double>(width == 4 ? operators.record[3 * p + d][m] : operators.wide[3 * p + d][m]);
}

/// derived[d][m]: operator m along d applied to the field f at point i.
using Derived = std::array<std::array<double, 8>, 3>;

template<class T>
Derived derive(const GradientOperators<T>& operators, std::size_t i,
               const std::function<double(std::size_t)>& f) {
  Derived sum{};
  for (std::uint32_t p = operators.start[i - operators.begin]; p < operators.start[i - operators.begin + 1];
       ++p)
    for (int d = 0; d < 3; ++d)
      for (int m = 0; m < 8; ++m)
        sum[d][m] += f(operators.stencil[operators.column[p]]) * entry(operators, p, d, m);
  return sum;
}

/// Returns the result of operator m for a field of gradient 1: 1 for gradient operators, 0 for operators of
/// differences and for unused ones.
double expected(const OperatorLayout& layout, int m) {
  return m == 0 || (layout.use == OperatorUse::subpoints && m < layout.count) ? 1 : 0;
}

class GradientOperatorsTest : public ::testing::TestWithParam<Case> {
protected:
  /// Checks that gradients of constants vanish and those of linear fields are exact at every point, including
  /// faces, edges and corners.
  template<class T> static void expect_exact(const Points& points, double tolerance) {
    const auto operators = operators_of<T>(points, GetParam(), 0, points.owned);
    EXPECT_EQ(operators.isolated, 0u);
    EXPECT_EQ(operators.regularized, 0u);
    EXPECT_GT(operators.smallest_fraction, singular_fraction);
    EXPECT_LT(operators.smallest_fraction, 0.3);
    for (std::size_t i = 0; i < points.owned; ++i) {
      const Derived one = derive(operators, i, [](std::size_t) { return 1.0; });
      for (int d = 0; d < 3; ++d)
        for (int m = 0; m < 8; ++m) EXPECT_NEAR(one[d][m] * spacing, 0, tolerance) << i;
      for (int c = 0; c < 3; ++c) {
        const Derived g = derive(operators, i, [&](std::size_t j) { return points.position[j][c]; });
        for (int d = 0; d < 3; ++d)
          for (int m = 0; m < 8; ++m)
            EXPECT_NEAR(g[d][m], d == c ? expected(operators.layout, m) : 0, 10 * tolerance) << i;
      }
    }
  }
};
INSTANTIATE_TEST_SUITE_P(Schemes, GradientOperatorsTest, ::testing::ValuesIn(schemes),
                         [](const auto& instance) { return instance.param.name; });

TEST_P(GradientOperatorsTest, ConstantsVanishAndLinearsAreExactAtEveryPointOfAJitteredBlock) {
  const Points points = points_at(jittered_lattice(6, spacing, 0.2), spacing);
  expect_exact<double>(points, 1e-12);
  expect_exact<float>(points, 3e-5);
}

TEST_P(GradientOperatorsTest, AlsoAtSymmetryPlanesWithGhosts) {
  Points points = points_at(jittered_lattice(6, spacing, 0.2), spacing);
  Ghosts ghosts(SymmetryPlanes{{true, true, false}});
  ghosts.rebuild(points, {4 * spacing, 4 * spacing, 4 * spacing});
  expect_exact<double>(points, 1e-12);
}

TEST_P(GradientOperatorsTest, AlsoWhenSupportsFollowALargeDeformation) {
  // The points store this homogeneous map of the block, so that supports stretch with it.
  const Mat3 map = {1.8, 0.4, 0, -0.3, 0.7, 0.2, 0, 0.1, 0.9};
  auto positions = jittered_lattice(6, spacing, 0.15);
  for (Vec3& x : positions)
    x = {map[0] * x[0] + map[1] * x[1] + map[2] * x[2], map[3] * x[0] + map[4] * x[1] + map[5] * x[2],
         map[6] * x[0] + map[7] * x[1] + map[8] * x[2]};
  Points points = points_at(positions, spacing);
  points.reference.assign(points.owned, map);
  expect_exact<double>(points, 1e-11);
}

TEST_P(GradientOperatorsTest, AQuarterWithGhostsHasTheOperatorsOfTheWholeBody) {
  Points quarter = points_at(jittered_lattice(5, spacing, 0.2), spacing);
  Ghosts ghosts(SymmetryPlanes{{true, true, false}});
  ghosts.rebuild(quarter, {1, 1, 1}); // all images complete the whole body
  std::vector<Vec3> positions;
  for (std::size_t j = 0; j < quarter.owned + ghosts.size(); ++j) positions.push_back(quarter.position[j]);
  const Points whole = points_at(positions, spacing);
  ghosts.rebuild(quarter, {2.6 * spacing, 2.6 * spacing, 0}); // only images within reach
  const auto a = operators_of<double>(quarter, GetParam(), 0, quarter.owned),
             b = operators_of<double>(whole, GetParam(), 0, quarter.owned);
  // The field has no symmetry and is no polynomial.
  const auto field = [](const Points& p) {
    return [&p](std::size_t j) {
      const Vec3 x = p.position[j];
      return std::sin(300 * x[0] + 1) * std::exp(100 * x[1]) + std::cos(200 * x[2] * x[0] / spacing);
    };
  };
  for (std::size_t i = 0; i < quarter.owned; ++i) {
    const Derived qa = derive(a, i, field(quarter)), qb = derive(b, i, field(whole));
    for (int d = 0; d < 3; ++d)
      for (int m = 0; m < 8; ++m) EXPECT_NEAR(qa[d][m], qb[d][m], 1e-9 * (1 + std::abs(qb[d][m]))) << i;
  }
}

TEST_P(GradientOperatorsTest, BlocksOfPointsHaveTheOperatorsOfOneBlock) {
  const Points points = points_at(jittered_lattice(5, spacing, 0.2), spacing);
  const auto all = operators_of<float>(points, GetParam(), 0, points.owned),
             part = operators_of<float>(points, GetParam(), 40, 75);
  ASSERT_TRUE(std::is_sorted(part.stencil.begin(), part.stencil.end()));
  EXPECT_EQ(std::adjacent_find(part.stencil.begin(), part.stencil.end()), part.stencil.end());
  for (std::size_t i = 40; i < 75; ++i) {
    const std::uint32_t pa = all.start[i], pb = part.start[i - 40], n = part.start[i - 39] - pb;
    ASSERT_EQ(all.start[i + 1] - pa, n);
    for (std::uint32_t p = 0; p < n; ++p) {
      EXPECT_EQ(all.stencil[all.column[pa + p]], part.stencil[part.column[pb + p]]);
      for (int d = 0; d < 3; ++d)
        for (int m = 0; m < 8; ++m) EXPECT_EQ(entry(all, pa + p, d, m), entry(part, pb + p, d, m));
    }
  }
}

TEST_P(GradientOperatorsTest, FragmentsAreCountedAndLoneOnesHaveNoGradient) {
  // A block, a flat flake of nine points and a pair of points, far from each other.
  auto positions = jittered_lattice(4, spacing, 0.1);
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) positions.push_back({1 + 0.7 * spacing * i, 1 + 0.7 * spacing * j, 1});
  positions.push_back({2, 2, 2});
  positions.push_back({2 + 0.5 * spacing, 2, 2});
  const Points points = points_at(positions, spacing);
  const auto operators = operators_of<double>(points, GetParam(), 0, points.owned);
  EXPECT_EQ(operators.isolated, 2u);
  EXPECT_EQ(operators.regularized, 9u);
  for (std::size_t i = points.owned - 2; i < points.owned; ++i)
    EXPECT_EQ(operators.start[i], operators.start[i + 1]);
  for (std::size_t i = 64; i < 73; ++i) {
    const Derived one = derive(operators, i, [](std::size_t) { return 1.0; });
    for (int d = 0; d < 3; ++d)
      for (int m = 0; m < 8; ++m) EXPECT_NEAR(one[d][m] * spacing, 0, 1e-12);
  }
}

TEST(StabilisedGradientOperators, DerivativesMeasureTheCurvatureOverTheCell) {
  // f = x y over a fine symmetric lattice: d f/dx = y, so its derivative along the cell's edge k = y,
  // weighted with sqrt(h^2 / 12), is h / sqrt 12, and nothing else changes.
  const Points points = points_at(jittered_lattice(7, spacing, 0), spacing);
  const auto operators = operators_of<double>(points, nsni, 0, points.owned);
  const std::size_t centre = 3 + 7 * (3 + 7 * 3);
  const Derived g =
      derive(operators, centre, [&](std::size_t j) { return points.position[j][0] * points.position[j][1]; });
  const double expected = spacing / std::sqrt(12.0);
  for (int d = 0; d < 3; ++d)
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(g[d][1 + k] / expected, (d == 0 && k == 1) || (d == 1 && k == 0) ? 1 : 0, 0.1) << d << k;
}

/// Returns the sum of squares of the operators that measure variation, for the gradient of f at a point; for
/// sub-points the mean square of their deviations from the mean.
double variation(const GradientOperators<double>& operators, std::size_t i,
                 const std::function<double(std::size_t)>& f) {
  const Derived g = derive(operators, i, f);
  const bool subpoints = operators.layout.use == OperatorUse::subpoints;
  double sum = 0;
  for (int d = 0; d < 3; ++d) {
    double mean = 0, squares = 0;
    for (int m = subpoints ? 0 : 1; m < operators.layout.count; ++m)
      mean += g[d][m], squares += g[d][m] * g[d][m];
    const double n = operators.layout.count;
    sum += subpoints ? squares / n - mean * mean / n / n : squares;
  }
  return sum;
}

/// Schemes with operators that measure the variation of the gradient over the cell.
class VariationTest : public ::testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Schemes, VariationTest, ::testing::ValuesIn(schemes.begin() + 2, schemes.end()),
                         [](const auto& instance) { return instance.param.name; });

TEST_P(VariationTest, TheVariationOfAQuadraticIsTheSecondMomentOfTheSamples) {
  const OperatorLayout layout = layout_of(GetParam().integration);
  ASSERT_NE(layout.use, OperatorUse::gradient);
  // Over the cell the gradient of x y varies by (y, x, 0): variance 2 m h^2 with the second moment m h^2 of
  // the samples. The smoothing by the kernel reduces it by the same few percent in every scheme.
  const Points points = points_at(jittered_lattice(7, spacing, 0), spacing);
  const auto operators = operators_of<double>(points, GetParam(), 0, points.owned);
  const bool centroids = GetParam().integration.scheme == Scheme::m_snni;
  const double moment = !centroids ? 1. / 12 : GetParam().integration.subcells == 6 ? 3. / 64 : 1. / 16;
  const double found = variation(operators, 3 + 7 * (3 + 7 * 3), [&](std::size_t j) {
    return points.position[j][0] * points.position[j][1];
  });
  EXPECT_NEAR(found / (2 * moment * spacing * spacing), 1, 0.1);
}

} // namespace
} // namespace spall::test
