// Rigid bodies do not touch each other: what could meet is known before, and what meets is seen.

#include "macro/contact/rigid_pairs.h"

#include "macro/shape/projectile.h"

#include <gtest/gtest.h>

namespace spall::test::of_pairs {
namespace {

RigidBody ball(const std::string& name, const Vec3& middle, const Vec3& velocity) {
  RigidBody body;
  body.name = name;
  body.shape = Revolution{.outer = sphere_contour(0.1)};
  body.mass = 1;
  body.position = middle + Vec3{0, 0, 0.05};
  body.velocity = velocity;
  return body;
}
RigidBody wall() { return {.name = "wall", .shape = PlaneWall{}, .free = {false, false, false}}; }
std::size_t crossing(const RigidBody& a, const RigidBody& b) { return RigidPairs::crossing({a, b}).size(); }

TEST(RigidPairs, PathsCrossWhereTheyComeNearerThanTheirRadii) {
  const RigidBody one = ball("one", {0, 0, 0}, {0, 0, 300});
  EXPECT_EQ(crossing(one, ball("two", {0, 0, -1}, {0, 0, 300})), 1U) << "one behind the other";
  EXPECT_EQ(crossing(one, ball("two", {0.099, 0, -1}, {0, 0, 300})), 1U);
  EXPECT_EQ(crossing(one, ball("two", {0.101, 0, -1}, {0, 0, 300})), 0U) << "side by side";
  EXPECT_EQ(crossing(one, ball("two", {0, 0, -1}, {0, 0, -300})), 0U) << "away from each other";
  EXPECT_EQ(crossing(one, ball("two", {0, 0, 1}, {0, 0, -300})), 1U) << "at each other";
  EXPECT_EQ(crossing(one, ball("two", {1, 0, 1}, {-200, 0, 0})), 1U) << "across, at whatever time";
  EXPECT_EQ(crossing(one, ball("two", {1, 0.09, 1}, {-200, 0, 0})), 1U);
  EXPECT_EQ(crossing(one, ball("two", {1, 0.11, 1}, {-200, 0, 0})), 0U) << "past each other";
  EXPECT_EQ(crossing(one, ball("two", {1, 0, 1}, {200, 0, 0})), 0U) << "begins beyond";
  EXPECT_EQ(crossing(one, ball("two", {0, 0, 2}, {})), 1U) << "one at rest in the way";
}

TEST(RigidPairs, AWallIsMetByWhatFliesAtIt) {
  EXPECT_EQ(crossing(ball("one", {0, 0, 1}, {0, 0, -300}), wall()), 1U);
  EXPECT_EQ(crossing(wall(), ball("one", {0, 0, 1}, {10, 0, 300})), 0U);
  EXPECT_EQ(crossing(wall(), wall()), 0U) << "held bodies do not meet";
}

TEST(RigidPairs, OverlapIsSeenFromBothSides) {
  std::vector<RigidBody> bodies = {ball("one", {0, 0, 0}, {}), ball("two", {0, 0, 0.1}, {})};
  RigidPairs pairs(bodies);
  EXPECT_FALSE(pairs.overlapping(bodies)) << "they touch";
  bodies[1].position[2] -= 1e-3;
  ASSERT_TRUE(pairs.overlapping(bodies));
  EXPECT_EQ(pairs.overlapping(bodies)->first, "one");
  EXPECT_EQ(pairs.overlapping(bodies)->second, "two");
  bodies[1].position[0] += 0.2;
  EXPECT_FALSE(pairs.overlapping(bodies));

  std::vector<RigidBody> at_wall = {wall(), ball("one", {0, 0, 0.051}, {})};
  RigidPairs with_wall(at_wall);
  EXPECT_FALSE(with_wall.overlapping(at_wall));
  at_wall[1].position[2] -= 2e-3;
  EXPECT_TRUE(with_wall.overlapping(at_wall));
}

} // namespace
} // namespace spall::test::of_pairs
