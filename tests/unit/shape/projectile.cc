#include "macro/shape/projectile.h"

#include "tests/unit/points/clouds.h"
#include "tests/unit/shape/samples.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace spall::test {
namespace {

/// Returns the largest difference between the distances to two bodies, over places around the noses, m.
double difference(const Contour& a, const Contour& b) {
  double largest = 0;
  for (const Vec3& x : random_cloud(2000, {-0.04, -0.04, -0.1}, {0.04, 0.04, 0.03}))
    largest = std::max(largest, std::abs(a.surface(x).distance - b.surface(x).distance));
  return largest;
}
Contour hemisphere() { return with({.kind = NoseKind::hemisphere}).contour(); }

TEST(Projectile, ATruncatedOgiveTendsToTheOgive) {
  const Contour whole = with({.kind = NoseKind::ogive, .caliber_radius_head = 3}).contour();
  for (const double tip : {1e-3, 1e-6, 0.0}) {
    const Contour cut =
        with({.kind = NoseKind::truncated_ogive, .caliber_radius_head = 3, .tip_diameter = tip}).contour();
    EXPECT_LE(difference(cut, whole), 3 * tip);
    const double volume = whole.mass_properties().volume;
    EXPECT_NEAR(cut.mass_properties().volume, volume, 0.01 * tip + 1e-15 * volume);
  }
}

TEST(Projectile, ABluntOneRoundedByItsRadiusIsAHemisphereAndSoIsAnOgiveOfCalibreRadiusHeadOneHalf) {
  EXPECT_LE(difference(with({.kind = NoseKind::blunt, .edge_radius = 0.025}).contour(), hemisphere()), 1e-15);
  EXPECT_LE(difference(with({.kind = NoseKind::ogive, .caliber_radius_head = 0.5}).contour(), hemisphere()),
            1e-15);
  const MassProperties blunt =
                           with({.kind = NoseKind::blunt, .edge_radius = 0.025}).contour().mass_properties(),
                       round = hemisphere().mass_properties();
  EXPECT_NEAR(blunt.volume, round.volume, 1e-13 * round.volume);
}

TEST(Projectile, ABluntOneWithASharpEdgeIsFlat) {
  const Contour flat = with({.kind = NoseKind::flat}).contour();
  for (const double edge : {1e-3, 1e-6})
    EXPECT_LE(difference(with({.kind = NoseKind::blunt, .edge_radius = edge}).contour(), flat), edge);
}

TEST(Projectile, KinksAreWhereTheNoseEnds) {
  EXPECT_EQ(with({.kind = NoseKind::cone, .length = 0.06}).contour().kinks(),
            (std::vector{-0.2, -0.06, 0.0}));
  EXPECT_EQ(with({.kind = NoseKind::flat}).contour().kinks(), (std::vector{-0.2, 0.0}));
  EXPECT_EQ(hemisphere().kinks(), (std::vector{-0.2, -0.025, 0.0}));
}

TEST(Projectile, ImpossibleBodiesAreRefused) {
  EXPECT_THROW((Projectile{0.05, 0.02, {.kind = NoseKind::hemisphere}}.contour()), std::invalid_argument);
  EXPECT_THROW(with({.kind = NoseKind::ogive, .caliber_radius_head = 0.4}).contour(), std::invalid_argument);
  EXPECT_THROW(with({.kind = NoseKind::blunt, .edge_radius = 0.03}).contour(), std::invalid_argument);
  EXPECT_THROW(
      with({.kind = NoseKind::truncated_ogive, .caliber_radius_head = 2, .tip_diameter = 0.05}).contour(),
      std::invalid_argument);
  EXPECT_THROW(ContourBuilder({0, 0}).line_to({0, 1}).line_to({-1, 1}).contour(), std::invalid_argument);
}

TEST(Casing, ItsSideWallGivesItTheMetalAskedFor) {
  for (const Nose& nose :
       {Nose{.kind = NoseKind::ogive, .caliber_radius_head = 3},
        {.kind = NoseKind::hemisphere},
        {.kind = NoseKind::cone, .length = 0.06},
        {.kind = NoseKind::truncated_ogive, .caliber_radius_head = 3, .tip_diameter = 0.01},
        {.kind = NoseKind::flat},
        {.kind = NoseKind::blunt, .edge_radius = 0.01}}) {
    const Projectile p = with(nose);
    CasingWalls walls{.nose = 0.02, .base = 0.01};
    const double metal = 0.4 * p.contour().mass_properties().volume;
    walls.side = side_wall(p, walls, metal);
    EXPECT_GT(walls.side, 1e-3);
    const Revolution body = casing(p, walls);
    EXPECT_NEAR(body.mass_properties().volume, metal, 1e-10 * metal);
    // The cavity begins and ends at the given walls, and the wall of the shaft has its thickness.
    EXPECT_EQ(body.inner_radius(-0.0199), 0);
    EXPECT_GT(body.inner_radius(-0.0201), 0);
    EXPECT_EQ(body.inner_radius(-0.1901), 0);
    EXPECT_NEAR(body.outer_radius(-0.1) - body.inner_radius(-0.1), walls.side, 1e-15);
  }
}

TEST(Casing, ImpossibleWallsAreRefused) {
  const Projectile p = with({.kind = NoseKind::ogive, .caliber_radius_head = 3});
  EXPECT_THROW(casing(p, {.nose = 0.1, .base = 0.1, .side = 1e-3}), std::invalid_argument);
  EXPECT_THROW(casing(p, {.nose = 0.02, .base = 0.01, .side = 0.025}), std::invalid_argument);
  // If the base extends into the nose, the flat rear end of the cavity would be wider than the nose there.
  EXPECT_THROW(casing(p, {.nose = 0.02, .base = 0.13, .side = 0.004}), std::invalid_argument);
  EXPECT_EQ(side_wall(p, {.nose = 0.02, .base = 0.01}, 1.0),
            0); // the mass is larger than that of the solid body
  EXPECT_EQ(side_wall(p, {.nose = 0.02, .base = 0.01}, 1e-6),
            0); // the mass is smaller than that of nose and base
}

} // namespace
} // namespace spall::test
