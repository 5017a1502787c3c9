#include "macro/points/ghosts.h"

#include "tests/unit/points/clouds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace spall::test {
namespace {

Points random_points(std::size_t n) {
  Points points = points_at(random_cloud(n, {0, 0, 0}, {3, 3, 3}));
  const auto velocities = random_cloud(n, {-1, -1, -1}, {1, 1, 1}, 2);
  for (std::size_t i = 0; i < n; ++i) points.velocity.set(i, velocities[i]);
  return points;
}

/// The owner of an image and the signs of the reflection, found from the image's position alone.
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
  ADD_FAILURE() << "image " << image << " is not a mirror image of any point";
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
    // There is one image for every combination of planes that a point is near.
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

TEST(Ghosts, ForcesAreAddedToTheOwnersReflected) {
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

/// Makes points of a half plane with velocities in it.
Points half_plane() {
  Points points = random_points(200);
  for (std::size_t i = 0; i < points.owned; ++i) {
    points.position.component[1][i] = points.velocity.component[1][i] = 0;
    points.spacing[i] = 0.2;
  }
  return points;
}

TEST(Ghosts, AroundTheAxisImagesCompleteTheRingsWithinReach) {
  Points points = half_plane();
  Ghosts ghosts(SymmetryPlanes{.axis = true});
  const double reach = 0.7;
  ghosts.rebuild(points, {0, reach, 0});
  std::size_t expected = 0;
  for (std::size_t i = 0; i < points.owned; ++i) {
    const double r = points.position[i][0];
    const int n = points_on_ring(r, points.spacing[i]);
    EXPECT_EQ(n % 4, 0);
    EXPECT_NEAR(n * gap_on_ring(r, points.spacing[i]), 2 * M_PI * r, 1e-12);
    for (int k = 1; k < n; ++k) {
      const double y = r * std::sin(2 * M_PI * k / n), x = r * std::cos(2 * M_PI * k / n);
      expected += std::abs(y) < reach && x > -reach;
    }
  }
  EXPECT_EQ(ghosts.size(), expected);
  for (std::size_t g = points.owned; g < points.owned + ghosts.size(); ++g) {
    const std::uint32_t owner = ghosts.owner(points, static_cast<std::uint32_t>(g));
    const Vec3 x = points.position[g], v = points.velocity[g], o = points.position[owner],
               w = points.velocity[owner];
    EXPECT_NEAR(std::hypot(x[0], x[1]), o[0], 1e-12);
    EXPECT_EQ(x[2], o[2]);
    EXPECT_NEAR(v[0] * x[0] + v[1] * x[1], w[0] * o[0], 1e-12); // radial
    EXPECT_NEAR(v[0] * x[1] - v[1] * x[0], 0, 1e-12);           // around
    EXPECT_EQ(v[2], w[2]);
  }
}

TEST(Ghosts, AroundTheAxisForcesDoTheWorkOfTheirImages) {
  Points points = half_plane();
  Ghosts ghosts(SymmetryPlanes{.axis = true});
  ghosts.rebuild(points, {0, 1, 0});
  const std::size_t all = points.owned + ghosts.size();
  const auto forces = random_cloud(all, {-1, -1, -1}, {1, 1, 1}, 9);
  double gathered = 0, given = 0;
  for (std::size_t i = 0; i < all; ++i)
    points.force.set(i, forces[i]), gathered += dot(forces[i], points.velocity[i]);
  ghosts.add_back(points);
  for (std::size_t i = 0; i < points.owned; ++i) {
    given += dot(points.force[i], points.velocity[i]);
    EXPECT_EQ(points.force[i][1], 0);
  }
  EXPECT_NEAR(given, gathered, 1e-9 * all);
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
