#include "macro/contact/carried_surface.h"

#include "macro/shape/fill.h"
#include "macro/shape/projectile.h"
#include "tests/unit/points/clouds.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace spall::test {
namespace {

const Revolution ogive{.outer =
                           TangentOgive{.radius = 0.0254, .length = 0.2, .arc_radius = 6 * 0.0254}.contour()};
constexpr double spacing = 5e-3;

/// A solid ogive of points with its known surface, and its near points after a linear map.
struct Projectile {
  Points points;
  Ghosts ghosts;
  KnownSurface surface;
  NearPoints near;
  Mat3 map;
  Vec3 shift;

  Projectile(const Mat3& map_, const Vec3& shift_, const SymmetryPlanes& planes = {})
      : ghosts(planes), map(map_), shift(shift_) {
    points = fill(ogive, {.layers = 40}, planes, 1); // 5 mm
    surface = known_surface(ogive, identity3, {}, points);
    for (std::size_t i = 0; i < points.owned; ++i) {
      points.position.set(i, moved(points.position[i]));
      points.reference[i] = map;
    }
    ghosts.rebuild(points, {0, 10 * spacing, 0});
    near.rebuild(view(), {{-1, -1, -1}, {1, 1, 1}});
  }
  ContactBody view() { return {&points, &ghosts, 1, 1, &surface}; }
  Vec3 moved(const Vec3& x) const { return add(shift, 1, times(map, x)); }
  bool find(SurfacePatch& patch, const Vec3& x) {
    return find_carried_patch(patch, x, view(), near, 2 * spacing, 5 * spacing);
  }
};
const Mat3 turned = matrix_of(normalized({0.8, 0.3, -0.4, 0.33}));

/// Returns whether a place is near the tip or tail, where the surface has no unique normal.
bool at_an_edge(const Vec3& x) { return x[2] > -2 * spacing || x[2] < -ogive.length() + 2 * spacing; }

/// Random places up to a spacing inside and outside of the surface.
std::vector<Vec3> places() {
  std::vector<Vec3> chosen;
  for (const Vec3& x : random_cloud(4000, {-0.035, -0.035, -0.21}, {0.035, 0.035, 0.01}))
    if (std::abs(ogive.surface(x).distance) < spacing) chosen.push_back(x);
  return chosen;
}

TEST(CarriedSurface, OfABodyThatMovesRigidlyIsTheShapeItself) {
  Projectile body(turned, {0.1, -0.2, 0.3});
  std::size_t count = 0;
  for (const Vec3& x : places()) {
    SurfacePatch patch;
    ASSERT_TRUE(body.find(patch, body.moved(x)));
    const SurfacePoint exact = ogive.surface(x);
    // The patch is the tangent plane at the foot of x.
    EXPECT_NEAR(patch.gap, exact.distance, 1e-12);
    const Vec3 normal = times(turned, exact.normal);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(patch.normal[c], normal[c], 1e-12);
    ++count;
  }
  EXPECT_GT(count, 500u);
}

TEST(CarriedSurface, FollowsALinearMap) {
  const Mat3 map = multiply(turned, {1.2, 0.1, 0, 0, 0.9, 0, 0.05, 0, 1.1});
  Projectile body(map, {0, 0, 0.05});
  for (const Vec3& x : places()) {
    // A place on the surface remains on it, with the normal of the mapped surface.
    const SurfacePoint exact = ogive.surface(x);
    const Vec3 on = add(x, -exact.distance, exact.normal);
    SurfacePatch patch;
    ASSERT_TRUE(body.find(patch, body.moved(on)));
    EXPECT_NEAR(patch.gap, 0, 1e-12);
    if (at_an_edge(x)) continue;
    const Vec3 normal = times_transposed(inverse(map), ogive.surface(on).normal);
    EXPECT_NEAR(dot(patch.normal, normal), std::sqrt(dot(normal, normal)), 1e-9);
  }
}

TEST(CarriedSurface, WeightsAddUpToOneAndKeepTheMomentOfNormalForces) {
  Projectile body(turned, {});
  for (const Vec3& x : places()) {
    SurfacePatch patch;
    ASSERT_TRUE(body.find(patch, body.moved(x)));
    double sum = 0, largest = 0;
    Vec3 centre{};
    for (const PatchPoint& p : patch.points) {
      sum += p.weight;
      largest = std::max(largest, std::abs(p.weight));
      centre = add(centre, p.weight, body.points.position[p.index]);
    }
    EXPECT_NEAR(sum, 1, 1e-12);
    EXPECT_LT(largest, 1.2);
    // Away from edges the weighted mean of the patch lies below x along the normal.
    const Vec3 arm = cross(add(centre, -1, body.moved(x)), patch.normal);
    if (!at_an_edge(x)) {
      EXPECT_LT(std::sqrt(dot(arm, arm)), 1e-9);
    }
  }
}

TEST(CarriedSurface, OfAHalfModelWithImagesIsThatOfTheWhole) {
  const Mat3 map = {1.1, 0, 0.1, 0, 0.95, 0, -0.05, 0, 1}; // keeps the plane y = 0
  Projectile whole(map, {0.1, 0, 0}), half(map, {0.1, 0, 0}, {{false, true, false}});
  for (const Vec3& x : places()) {
    if (x[1] < 0) continue;
    SurfacePatch a, b;
    ASSERT_TRUE(whole.find(a, whole.moved(x)));
    ASSERT_TRUE(half.find(b, half.moved(x)));
    EXPECT_NEAR(a.gap, b.gap, 1e-12);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(a.normal[c], b.normal[c], 1e-12);
    EXPECT_EQ(a.points.size(), b.points.size());
  }
}

TEST(CarriedSurface, AFarPlaceHasNoPatch) {
  Projectile body(turned, {});
  SurfacePatch patch;
  EXPECT_FALSE(body.find(patch, body.moved({0.1, 0, -0.1})));
}

} // namespace
} // namespace spall::test
