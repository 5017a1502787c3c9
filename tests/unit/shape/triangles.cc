#include "macro/shape/triangles.h"

#include "tests/unit/shape/samples.h"

#include <gtest/gtest.h>

#include <set>
#include <utility>

namespace spall::test {
namespace {

class EverySurface : public ::testing::TestWithParam<NamedShape> {
protected:
  const Triangles surface_of_shape = triangles_of(GetParam().shape);
};
INSTANTIATE_TEST_SUITE_P(Shapes, EverySurface, ::testing::ValuesIn(every_shape()),
                         [](const auto& instance) { return instance.param.name; });

TEST_P(EverySurface, IsClosedAndEveryTwoNeighboursTurnTheSameWay) {
  std::set<std::pair<std::int64_t, std::int64_t>> edges;
  for (const auto& corners : surface_of_shape.corners)
    for (int k = 0; k < 3; ++k) {
      ASSERT_NE(corners[k], corners[(k + 1) % 3]);
      EXPECT_TRUE(edges.emplace(corners[k], corners[(k + 1) % 3]).second) << "an edge is used twice";
    }
  ASSERT_FALSE(edges.empty());
  for (const auto& [from, to] : edges) EXPECT_TRUE(edges.count({to, from})) << "an edge is open";
}

TEST_P(EverySurface, HasItsPointsOnTheShape) {
  for (const Vec3& x : surface_of_shape.points) EXPECT_NEAR(surface(GetParam().shape, x).distance, 0, 1e-12);
}

TEST_P(EverySurface, LooksOutwardsAndHoldsTheVolume) {
  double volume = 0;
  for (const auto& [a, b, c] : surface_of_shape.corners)
    volume +=
        dot(surface_of_shape.points[a], cross(surface_of_shape.points[b], surface_of_shape.points[c])) / 6;
  const double exact = mass_properties(GetParam().shape).volume;
  EXPECT_NEAR(volume, exact, 5e-3 * exact);
}

TEST(Triangles, ShapesWithoutEndHaveNone) {
  for (const Shape& shape : {Shape{PlaneWall{}}, Shape{Nothing{}}}) {
    EXPECT_TRUE(triangles_of(shape).points.empty());
    EXPECT_TRUE(triangles_of(shape).corners.empty());
  }
}

} // namespace
} // namespace spall::test
