#include "macro/points/ghosts.h"

#include "tests/unit/points/clouds.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace spall::test {
namespace {

Points random_points(std::size_t n) {
  Points points = points_at(random_cloud(n, {0, 0, 0}, {3, 3, 3}));
  const auto velocities = random_cloud(n, {-1, -1, -1}, {1, 1, 1}, 2);
  for (std::size_t i = 0; i < n; ++i) points.velocity.set(i, velocities[i]);
  return points;
}

/// The owner of an image and the signs of the mirroring, found from its position alone.
struct Mirrored {
  std::size_t owner;
  Vec3 sign;
};
Mirrored owner_of(const Points& points, std::size_t image) {
  const Vec3 x = points.position[image];
  for (std::size_t i = 0; i < points.owned; ++i) {
    const Vec3 y = points.position[i];
    if (std::abs(x[0]) == y[0] && std::abs(x[1]) == y[1] && std::abs(x[2]) == y[2])
      return {i, {x[0] < 0 ? -1. : 1., x[1] < 0 ? -1. : 1., x[2] < 0 ? -1. : 1.}};
  }
  ADD_FAILURE() << "image " << image << " is nobody's mirror image";
  return {0, {1, 1, 1}};
}

TEST(Ghosts, AreTheMirrorImagesOfExactlyThePointsWithinReach) {
  for (const std::array<bool, 3> planes :
       {std::array{true, false, false}, {true, true, false}, {true, true, true}}) {
    Points points = random_points(300);
    Ghosts ghosts(SymmetryPlanes{planes});
    const Vec3 reach = {0.7, 1.1, 0.4};
    ghosts.rebuild(points, reach);
    ASSERT_EQ(points.position.component[0].size(), points.owned + ghosts.size());
    std::vector<Mirrored> found;
    for (std::size_t g = points.owned; g < points.owned + ghosts.size(); ++g) {
      const Mirrored m = owner_of(points, g);
      for (int c = 0; c < 3; ++c) {
        if (m.sign[c] < 0) {
          EXPECT_TRUE(planes[c]);
          EXPECT_LT(-points.position[g][c], reach[c]);
        }
        EXPECT_EQ(points.velocity[g][c], m.sign[c] * points.velocity[m.owner][c]);
      }
      found.push_back(m);
    }
    // Every combination of planes a point is near to, each once.
    std::size_t expected = 0;
    for (std::size_t i = 0; i < points.owned; ++i) {
      std::size_t images = 1;
      for (int c = 0; c < 3; ++c) images *= planes[c] && points.position[i][c] < reach[c] ? 2 : 1;
      expected += images - 1;
    }
    EXPECT_EQ(ghosts.size(), expected);
    const auto key = [](const Mirrored& m) { return std::pair(m.owner, m.sign); };
    std::sort(found.begin(), found.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
    EXPECT_EQ(std::adjacent_find(found.begin(), found.end(),
                                 [&](const auto& a, const auto& b) { return key(a) == key(b); }),
              found.end());
  }
}

TEST(Ghosts, FollowTheirOwners) {
  Points points = random_points(100);
  Ghosts ghosts(SymmetryPlanes{{true, true, false}});
  ghosts.rebuild(points, {1, 1, 1});
  std::vector<Mirrored> owner;
  for (std::size_t g = points.owned; g < points.owned + ghosts.size(); ++g)
    owner.push_back(owner_of(points, g));
  const auto moved = random_cloud(points.owned, {0, 0, 0}, {3, 3, 3}, 5);
  for (std::size_t i = 0; i < points.owned; ++i) {
    points.position.set(i, moved[i]);
    points.velocity.set(i, moved[points.owned - 1 - i]);
  }
  ghosts.refresh(points);
  for (std::size_t g = 0; g < owner.size(); ++g)
    for (int c = 0; c < 3; ++c) {
      EXPECT_EQ(points.position[points.owned + g][c], owner[g].sign[c] * points.position[owner[g].owner][c]);
      EXPECT_EQ(points.velocity[points.owned + g][c], owner[g].sign[c] * points.velocity[owner[g].owner][c]);
    }
}

TEST(Ghosts, GiveTheirForcesBackToTheirOwnersMirrored) {
  Points points = random_points(100);
  Ghosts ghosts(SymmetryPlanes{{true, true, false}});
  ghosts.rebuild(points, {1, 1, 1});
  const std::size_t all = points.owned + ghosts.size();
  const auto forces = random_cloud(all, {-1, -1, -1}, {1, 1, 1}, 9);
  std::vector<Vec3> expected(forces.begin(), forces.begin() + static_cast<std::ptrdiff_t>(points.owned));
  for (std::size_t i = 0; i < all; ++i) points.force.set(i, forces[i]);
  for (std::size_t g = points.owned; g < all; ++g) {
    const Mirrored m = owner_of(points, g);
    for (int c = 0; c < 3; ++c) expected[m.owner][c] += m.sign[c] * forces[g][c];
  }
  ghosts.add_back(points);
  for (std::size_t i = 0; i < points.owned; ++i)
    for (int c = 0; c < 3; ++c) EXPECT_DOUBLE_EQ(points.force[i][c], expected[i][c]);
}

TEST(Ghosts, WithoutPlanesThereAreNone) {
  Points points = random_points(50);
  Ghosts ghosts;
  ghosts.rebuild(points, {9, 9, 9});
  EXPECT_EQ(ghosts.size(), 0u);
}

TEST(SymmetryPlanes, MultiplicityIsTheNumberOfMirrorImages) {
  EXPECT_EQ((SymmetryPlanes{}.multiplicity()), 1);
  EXPECT_EQ((SymmetryPlanes{{false, true, false}}.multiplicity()), 2);
  EXPECT_EQ((SymmetryPlanes{{true, true, false}}.multiplicity()), 4);
  EXPECT_EQ((SymmetryPlanes{{true, true, true}}.multiplicity()), 8);
}

} // namespace
} // namespace spall::test
