#include "macro/integration/gradient_rows.h"

#include "macro/points/ghosts.h"
#include "tests/unit/points/clouds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

namespace spall::test {
namespace {

constexpr double spacing = 0.01;
constexpr SupportInputs support_inputs{};

template<class T>
GradientRows<T> rows_of(const Points& points, Scheme scheme, std::size_t begin, std::size_t end) {
  NeighborSearch search;
  search.rebuild(points, spacing);
  std::vector<Support> supports;
  for (std::size_t i = begin; i < end; ++i)
    supports.push_back(make_support(points.deformation(i), points.spacing[i], support_inputs));
  GradientRows<T> rows;
  rows.begin = begin, rows.end = end;
  RowScratch<T> scratch;
  build_rows(rows, points, search, supports, scheme, support_inputs.normalized_size, scratch);
  return rows;
}

/// lanes[d][m]: derivative along d of the field f at the point; m = 0 the gradient, 1-3 its derivatives.
using Derived = std::array<Lanes<double>, 3>;

template<class T>
Derived derive(const GradientRows<T>& rows, std::size_t i, Scheme scheme,
               const std::function<double(std::size_t)>& f) {
  Derived sum{};
  for (std::uint32_t p = rows.start[i - rows.begin]; p < rows.start[i - rows.begin + 1]; ++p) {
    const double value = f(rows.touched[rows.column[p]]);
    for (int d = 0; d < 3; ++d)
      for (int m = 0; m < 4; ++m) {
        if (is_stabilized(scheme))
          sum[d][m] += value * static_cast<double>(rows.record[3 * p + d][m]);
        else if (m == 0)
          sum[d][m] += value * static_cast<double>(rows.record[p][d]);
      }
  }
  return sum;
}

struct Case {
  Scheme scheme;
  const char* name;
};
void PrintTo(const Case& c, std::ostream* stream) { *stream << c.name; }

/// True for points at a free face of the n x n x n lattice; `planes`: low faces that are not free.
bool at_surface(std::size_t i, std::size_t n, const std::array<bool, 3>& planes) {
  const std::size_t at[3] = {i % n, i / n % n, i / n / n};
  int faces = 0;
  for (int c = 0; c < 3; ++c) faces += (at[c] == 0 && !planes[c]) || at[c] == n - 1;
  return faces > 0;
}

class GradientRowsTest : public ::testing::TestWithParam<Case> {
protected:
  /// Gradients of constants vanish at every point of the 6 x 6 x 6 block; those of linears are exact, except
  /// for SNNI at free surfaces: faces of the cells there may lie outside the body and see a cloud that cannot
  /// hold the linear basis.
  template<class T>
  static void expect_exact(const Points& points, double tolerance, const std::array<bool, 3>& planes = {}) {
    const Scheme scheme = GetParam().scheme;
    const auto rows = rows_of<T>(points, scheme, 0, points.owned);
    EXPECT_EQ(rows.isolated, 0u);
    std::size_t surface = 0;
    const auto component = [&](int c) {
      return [&points, c](std::size_t j) { return points.position[j][c]; };
    };
    for (std::size_t i = 0; i < points.owned; ++i) {
      const Derived one = derive<T>(rows, i, scheme, [](std::size_t) { return 1.0; });
      for (int d = 0; d < 3; ++d)
        for (int m = 0; m < 4; ++m) EXPECT_NEAR(one[d][m] * spacing, 0, tolerance) << i;
      const bool outer = at_surface(i, 6, planes);
      surface += outer;
      if (outer && scheme == Scheme::snni) continue;
      for (int c = 0; c < 3; ++c) {
        const Derived g = derive<T>(rows, i, scheme, component(c));
        for (int d = 0; d < 3; ++d)
          for (int m = 0; m < 4; ++m) EXPECT_NEAR(g[d][m], m == 0 && d == c ? 1 : 0, 10 * tolerance) << i;
      }
    }
    EXPECT_LE(rows.regularized, scheme == Scheme::snni ? surface : 0);
  }
};
INSTANTIATE_TEST_SUITE_P(Schemes, GradientRowsTest,
                         ::testing::Values(Case{Scheme::dni, "DNI"}, Case{Scheme::snni, "SNNI"},
                                           Case{Scheme::nsni, "NSNI"}),
                         [](const auto& instance) { return std::string(instance.param.name); });

TEST_P(GradientRowsTest, ConstantsVanishAndLinearsAreExactAtEveryPointOfAJitteredBlock) {
  const Points points = points_at(jittered_lattice(6, spacing, 0.2), spacing);
  expect_exact<double>(points, 1e-12);
  expect_exact<float>(points, 3e-5);
}

TEST_P(GradientRowsTest, AlsoAtSymmetryPlanesWithGhosts) {
  Points points = points_at(jittered_lattice(6, spacing, 0.2), spacing);
  Ghosts ghosts(SymmetryPlanes{{true, true, false}});
  ghosts.rebuild(points, {4 * spacing, 4 * spacing, 4 * spacing});
  expect_exact<double>(points, 1e-12, {true, true, false});
}

TEST_P(GradientRowsTest, AlsoWhenSupportsFollowALargeDeformation) {
  // A homogeneous map of the block, known to the points: supports stretch with it.
  const Mat3 map = {1.8, 0.4, 0, -0.3, 0.7, 0.2, 0, 0.1, 0.9};
  auto positions = jittered_lattice(6, spacing, 0.15);
  for (Vec3& x : positions)
    x = {map[0] * x[0] + map[1] * x[1] + map[2] * x[2], map[3] * x[0] + map[4] * x[1] + map[5] * x[2],
         map[6] * x[0] + map[7] * x[1] + map[8] * x[2]};
  Points points = points_at(positions, spacing);
  points.reference.assign(points.owned, map);
  expect_exact<double>(points, 1e-11);
}

TEST_P(GradientRowsTest, AQuarterWithGhostsHasTheRowsOfTheWholeBody) {
  Points quarter = points_at(jittered_lattice(5, spacing, 0.2), spacing);
  Ghosts ghosts(SymmetryPlanes{{true, true, false}});
  ghosts.rebuild(quarter, {1, 1, 1}); // all images: the whole body
  std::vector<Vec3> positions;
  for (std::size_t j = 0; j < quarter.owned + ghosts.size(); ++j) positions.push_back(quarter.position[j]);
  const Points whole = points_at(positions, spacing);
  ghosts.rebuild(quarter, {2.6 * spacing, 2.6 * spacing, 0}); // those within reach only
  const Scheme scheme = GetParam().scheme;
  const auto a = rows_of<double>(quarter, scheme, 0, quarter.owned),
             b = rows_of<double>(whole, scheme, 0, quarter.owned);
  // A field without symmetry or polynomial form, of the position only.
  const auto field = [](const Points& p) {
    return [&p](std::size_t j) {
      const Vec3 x = p.position[j];
      return std::sin(300 * x[0] + 1) * std::exp(100 * x[1]) + std::cos(200 * x[2] * x[0] / spacing);
    };
  };
  for (std::size_t i = 0; i < quarter.owned; ++i) {
    const Derived qa = derive<double>(a, i, scheme, field(quarter)),
                  qb = derive<double>(b, i, scheme, field(whole));
    for (int d = 0; d < 3; ++d)
      for (int m = 0; m < 4; ++m) EXPECT_NEAR(qa[d][m], qb[d][m], 1e-9 * (1 + std::abs(qb[d][m]))) << i;
  }
}

TEST_P(GradientRowsTest, BlocksOfPointsHaveTheRowsOfOneBlock) {
  const Points points = points_at(jittered_lattice(5, spacing, 0.2), spacing);
  const Scheme scheme = GetParam().scheme;
  const auto all = rows_of<float>(points, scheme, 0, points.owned),
             part = rows_of<float>(points, scheme, 40, 75);
  const std::size_t per_pair = is_stabilized(scheme) ? 3 : 1;
  ASSERT_TRUE(std::is_sorted(part.touched.begin(), part.touched.end()));
  EXPECT_EQ(std::adjacent_find(part.touched.begin(), part.touched.end()), part.touched.end());
  for (std::size_t i = 40; i < 75; ++i) {
    const std::uint32_t pa = all.start[i], pb = part.start[i - 40], n = part.start[i - 39] - pb;
    ASSERT_EQ(all.start[i + 1] - pa, n);
    for (std::uint32_t p = 0; p < n; ++p) {
      EXPECT_EQ(all.touched[all.column[pa + p]], part.touched[part.column[pb + p]]);
      for (std::size_t r = 0; r < per_pair; ++r)
        for (int m = 0; m < 4; ++m)
          EXPECT_EQ(all.record[per_pair * (pa + p) + r][m], part.record[per_pair * (pb + p) + r][m]);
    }
  }
}

TEST_P(GradientRowsTest, FragmentsAreCountedAndLoneOnesHaveNoGradient) {
  // A block, a flat flake of nine points and a pair of points, far from each other.
  auto positions = jittered_lattice(4, spacing, 0.1);
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) positions.push_back({1 + 0.7 * spacing * i, 1 + 0.7 * spacing * j, 1});
  positions.push_back({2, 2, 2});
  positions.push_back({2 + 0.5 * spacing, 2, 2});
  const Points points = points_at(positions, spacing);
  const Scheme scheme = GetParam().scheme;
  const auto rows = rows_of<double>(points, scheme, 0, points.owned);
  EXPECT_EQ(rows.isolated, 2u);
  if (scheme == Scheme::snni)
    EXPECT_GE(rows.regularized, 9u); // and some at the block's surface
  else
    EXPECT_EQ(rows.regularized, 9u);
  for (std::size_t i = points.owned - 2; i < points.owned; ++i) EXPECT_EQ(rows.start[i], rows.start[i + 1]);
  for (std::size_t i = 64; i < 73; ++i) {
    const Derived one = derive<double>(rows, i, scheme, [](std::size_t) { return 1.0; });
    for (int d = 0; d < 3; ++d)
      for (int m = 0; m < 4; ++m) EXPECT_NEAR(one[d][m] * spacing, 0, 1e-12);
  }
}

TEST(GradientRowsStabilised, DerivativesMeasureTheCurvatureOverTheCell) {
  // f = x y over a fine symmetric lattice: d f/dx = y, so its derivative along the cell's edge k = y,
  // weighted with sqrt(h^2 / 12), is h / sqrt 12, and nothing else changes.
  const Points points = points_at(jittered_lattice(7, spacing, 0), spacing);
  const auto rows = rows_of<double>(points, Scheme::nsni, 0, points.owned);
  const std::size_t centre = 3 + 7 * (3 + 7 * 3);
  const Derived g = derive<double>(rows, centre, Scheme::nsni, [&](std::size_t j) {
    return points.position[j][0] * points.position[j][1];
  });
  const double expected = spacing / std::sqrt(12.0);
  for (int d = 0; d < 3; ++d)
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(g[d][1 + k] / expected, (d == 0 && k == 1) || (d == 1 && k == 0) ? 1 : 0, 0.1) << d << k;
}

} // namespace
} // namespace spall::test
