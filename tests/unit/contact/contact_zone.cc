#include "macro/contact/contact_zone.h"

#include "tests/unit/points/clouds.h"

#include <gtest/gtest.h>

namespace spall::test {
namespace {

constexpr double spacing = 1e-3;

/// A cube with 8 points along an edge, and its lowest corner at `corner`.
struct Cube {
  Points points;
  Ghosts ghosts;
  explicit Cube(const Vec3& corner, const SymmetryPlanes& planes = {}) : ghosts(planes) {
    std::vector<Vec3> positions = jittered_lattice(8, spacing, 0);
    for (Vec3& x : positions)
      for (int c = 0; c < 3; ++c) x[c] += corner[c];
    points = points_at(positions, spacing);
  }
  ContactBody view() { return {&points, &ghosts}; }
};

TEST(ContactZone, GathersPointsNearTheOtherBodyAndReturnsTheirVelocities) {
  Cube lower({0, 0, 0}), upper({0, 0, 9 * spacing});
  for (std::size_t i = 0; i < upper.points.owned; ++i)
    upper.points.velocity.set(i, {0, 0, -1. - static_cast<double>(i)});
  ContactZone zone;
  zone.gather({lower.view(), upper.view()}, all_pairs(2, "surface"),
              2.5); // spacings from the outermost points of the other
  const std::vector<ContactBody>& near = zone.bodies();
  ASSERT_EQ(near.size(), 2u);
  ASSERT_EQ(near[1].points->owned, 64u); // one layer
  for (std::size_t k = 0; k < 64; ++k) {
    const std::uint64_t i = near[1].number(k);
    EXPECT_EQ(near[1].points->position[k], upper.points.position[i]);
    EXPECT_EQ(near[1].points->velocity[k], upper.points.velocity[i]);
    near[1].points->velocity.set(k, {3, 0, static_cast<double>(i)});
  }
  zone.give_back({lower.view(), upper.view()});
  std::size_t changed = 0;
  for (std::size_t i = 0; i < upper.points.owned; ++i) {
    const Vec3 v = upper.points.velocity[i];
    changed += v[0] == 3;
    EXPECT_EQ(v[2], v[0] == 3 ? static_cast<double>(i) : -1. - static_cast<double>(i));
  }
  EXPECT_EQ(changed, 64u);
}

TEST(ContactZone, IsEmptyWhileTheBodiesAreApart) {
  Cube lower({0, 0, 0}), upper({0, 0, 20 * spacing});
  ContactZone zone;
  zone.gather({lower.view(), upper.view()}, all_pairs(2, "surface"), 2);
  for (const ContactBody& body : zone.bodies()) EXPECT_EQ(body.points->owned, 0u);
}

TEST(ContactZone, HasImagesOfItsOwn) {
  const SymmetryPlanes quarter{{true, true, false}};
  Cube lower({0, 0, 0}, quarter), upper({0, 0, 8 * spacing}, quarter);
  ContactZone zone;
  zone.gather({lower.view(), upper.view()}, all_pairs(2, "surface"), 2);
  const ContactBody& body = zone.bodies()[0];
  // There are at least two layers of points and their images at each plane.
  EXPECT_GE(body.ghosts->size(), 2u * (2 * 2 * 8 + 2 * 2));
  double lowest = 0;
  for (const double x : body.points->position.component[0]) lowest = std::min(lowest, x);
  EXPECT_LT(lowest, -1.4 * spacing);
}

} // namespace
} // namespace spall::test
