// Images of rings joined to one neighbour give what the images gave.

#include "macro/integration/ring_operators.h"

#include "macro/shape/fill.h"
#include "macro/solid/pair_loops.h"

#include <gtest/gtest.h>

#include <random>

namespace spall::test {
namespace {

constexpr double spacing = 1e-3;

struct Meridian {
  Points points =
      fill_cylinder({.radius = 8e-3, .height = 6e-3}, {8, 6, Boundary::centred}, {.axis = true}, 1);
  Ghosts ghosts{SymmetryPlanes{.axis = true}};

  GradientOperators<double> operators(Scheme scheme) {
    ghosts.rebuild(points, {4 * spacing, 4 * spacing, 4 * spacing});
    IntegrationInputs integration{.scheme = scheme, .axisymmetric = true};
    const ApproximationInputs approximation;
    NeighborSearch search;
    search.rebuild(points, spacing);
    std::vector<Support> supports;
    for (std::size_t i = 0; i < points.owned; ++i)
      supports.push_back(make_support(identity3, spacing, approximation.support));
    GradientOperators<double> made;
    made.begin = 0, made.end = points.owned;
    OperatorScratch<double> scratch;
    EXPECT_EQ(build_gradient_operators(made,
                                       {.points = points,
                                        .search = search,
                                        .supports = supports,
                                        .approximation = approximation,
                                        .integration = integration},
                                       scratch),
              "");
    return made;
  }
  /// Velocities of a stencil: random along r and z, the same for all images of a ring.
  std::vector<Lanes<double>> velocities(const std::vector<std::uint32_t>& stencil) const {
    std::vector<Lanes<double>> v;
    for (const std::uint32_t j : stencil) {
      std::mt19937 engine(ghosts.owner(points, j) + 1);
      std::uniform_real_distribution<double> number(-1, 1);
      const double along_r = number(engine), along_z = number(engine);
      const Vec3 a =
          j < points.owned ? Vec3{along_r, 0, along_z} : ghosts.mirror(points, j, {along_r, 0, along_z});
      v.push_back(Lanes<double>{a[0], a[1], a[2], 0});
    }
    return v;
  }
  /// Forces on the stencil, gathered on the rings.
  std::vector<Vec3> on_rings(const std::vector<std::uint32_t>& stencil,
                             const std::vector<Lanes<double>>& f) const {
    std::vector<Vec3> sum(points.owned);
    for (std::size_t s = 0; s < stencil.size(); ++s) {
      const Vec3 force{f[s][0], f[s][1], f[s][2]};
      sum[ghosts.owner(points, stencil[s])] +=
          stencil[s] < points.owned ? force : ghosts.mirror_back(points, stencil[s], force);
    }
    return sum;
  }
};

template<int L> void expect_the_same(Scheme scheme) {
  Meridian body;
  const GradientOperators<double> images = body.operators(scheme);
  GradientOperators<double> rings = images;
  join_images(rings, body.ghosts, body.points);
  EXPECT_LT(2 * rings.column.size(), images.column.size());
  for (const std::uint32_t j : rings.stencil) EXPECT_LT(j, body.points.owned);
  const auto v_images = body.velocities(images.stencil), v_rings = body.velocities(rings.stencil);
  std::vector<Lanes<double>> f_images(images.stencil.size()), f_rings(rings.stencil.size());
  for (std::size_t i = 0; i < body.points.owned; ++i) {
    const auto a = gather_rates<L>(images, images.start[i], images.start[i + 1], v_images.data()),
               b = gather_rates<L>(rings, rings.start[i], rings.start[i + 1], v_rings.data());
    for (int m = 0; m < L; ++m)
      for (int c = 0; c < 9; ++c)
        EXPECT_NEAR((lane<L>(a, m)[c]), (lane<L>(b, m)[c]), 1e-10 / spacing) << i << " " << c;
    MatLanes<L> nominal{}; // an axisymmetric stress
    for (int m = 0; m < L; ++m) put_lane<L>(nominal, m, Mat3{1. + m, 0, 2, 0, 3, 0, -1, 0, 5. - m});
    scatter_forces<L>(images, images.start[i], images.start[i + 1], nominal, f_images.data());
    scatter_forces<L>(rings, rings.start[i], rings.start[i + 1], nominal, f_rings.data());
  }
  const auto a = body.on_rings(images.stencil, f_images), b = body.on_rings(rings.stencil, f_rings);
  for (std::size_t i = 0; i < a.size(); ++i)
    for (const int c : {0, 2}) EXPECT_NEAR(a[i][c], b[i][c], 1e-10 / spacing);
}

TEST(RingOperators, RatesAndForcesAreThoseOfTheImages) {
  expect_the_same<1>(Scheme::dni);
  expect_the_same<4>(Scheme::nsni);
  expect_the_same<4>(Scheme::subpoint);
}

/// Pushing forward and joining can change places.
TEST(RingOperators, PushForwardCommutes) {
  for (const Scheme scheme : {Scheme::dni, Scheme::subpoint}) {
    Meridian body;
    const std::vector<Mat3> relative(body.points.owned, {1.1, 0, 0.05, 0, 1.2, 0, -0.02, 0, 0.9});
    GradientOperators<double> first = body.operators(scheme), second = first;
    join_images(first, body.ghosts, body.points);
    push_forward(first, relative);
    push_forward(second, relative);
    join_images(second, body.ghosts, body.points);
    ASSERT_EQ(first.record.size(), second.record.size());
    for (std::size_t k = 0; k < first.record.size(); ++k)
      for (int m = 0; m < 4; ++m) EXPECT_NEAR(first.record[k][m], second.record[k][m], 1e-10 / spacing);
  }
}

} // namespace
} // namespace spall::test
