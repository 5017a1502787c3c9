#include "macro/shape/mass_properties.h"

#include "tests/unit/shape/samples.h"

#include <gtest/gtest.h>

namespace spall::test {
namespace {

constexpr double pi = std::numbers::pi;

void expect(const MassProperties& p, double volume, double centre, double axial, double transverse) {
  EXPECT_NEAR(p.volume, volume, 1e-11 * volume);
  EXPECT_NEAR(p.centre[2], centre, 1e-11 * std::abs(centre));
  EXPECT_NEAR(p.moments[2], axial, 1e-11 * axial);
  EXPECT_NEAR(p.moments[0], transverse, 1e-11 * transverse);
  EXPECT_NEAR(p.moments[1], transverse, 1e-11 * transverse);
}

TEST(MassProperties, AreThoseOfACylinderAConeAndASphere) {
  const double r = 0.3, h = 2;
  const MassProperties cylinder = revolve([&](double) { return r; }, {-h, 0});
  EXPECT_NEAR(cylinder.volume, pi * r * r * h, 1e-14);
  EXPECT_NEAR(cylinder.centre[2], -1, 1e-14);
  EXPECT_NEAR(cylinder.moments[2], r * r / 2, 1e-14);
  EXPECT_NEAR(cylinder.moments[0], r * r / 4 + h * h / 12, 1e-14);
  const MassProperties cone = revolve([&](double z) { return -r * z / h; }, {-h, 0});
  EXPECT_NEAR(cone.volume, pi * r * r * h / 3, 1e-14);
  EXPECT_NEAR(cone.centre[2], -0.75 * h, 1e-13);
  EXPECT_NEAR(cone.moments[2], 0.3 * r * r, 1e-14);
  EXPECT_NEAR(cone.moments[0], 3 * (4 * r * r + h * h) / 80, 1e-13);
  const MassProperties sphere = revolve([](double z) { return std::sqrt(1 - z * z); }, {-1, 0, 1});
  EXPECT_NEAR(sphere.moments[2], 0.4, 1e-12);
  EXPECT_NEAR(sphere.moments[0], 0.4, 1e-12);
}

TEST(MassProperties, OfContoursAreTheClosedForms) {
  const double r = 0.3, h = 2;
  expect(sphere_contour(2 * r).mass_properties(), 4 * pi / 3 * r * r * r, -r, 0.4 * r * r, 0.4 * r * r);
  // With a shaft of length 0 the body is a hemisphere or a cone.
  expect(Projectile{2 * r, r, {.kind = NoseKind::hemisphere}}.contour().mass_properties(),
         2 * pi / 3 * r * r * r, -0.625 * r, 0.4 * r * r, 83.0 / 320 * r * r);
  expect(Projectile{2 * r, h, {.kind = NoseKind::cone, .length = h}}.contour().mass_properties(),
         pi * r * r * h / 3, -0.75 * h, 0.3 * r * r, 3 * (4 * r * r + h * h) / 80);
  expect(Projectile{2 * r, h, {.kind = NoseKind::flat}}.contour().mass_properties(), pi * r * r * h, -h / 2,
         r * r / 2, r * r / 4 + h * h / 12);
  expect(Cylinder{.radius = r, .height = h, .bottom = -h}.mass_properties(), pi * r * r * h, -h / 2,
         r * r / 2, r * r / 4 + h * h / 12);
}

TEST(MassProperties, OfARoundedEdgeAreExactThoughItsArcEndsSquareToTheAxis) {
  // By Pappus' theorem the rounding removes a ring of section (1 - pi/4) e^2 from the corner.
  const double r = 0.3, h = 1, e = 0.1;
  const double from_centre =
      (0.5 - 1.0 / 3) / (1 - pi / 4) * e; // distance of the ring's centroid from the centre of the arc
  const double taken = (1 - pi / 4) * e * e * 2 * pi * (r - e + from_centre);
  const MassProperties p =
      Projectile{2 * r, h, {.kind = NoseKind::blunt, .edge_radius = e}}.contour().mass_properties();
  EXPECT_NEAR(p.volume, pi * r * r * h - taken, 1e-10);
}

TEST(MassProperties, ACavityIsSubtracted) {
  const double r = 0.3;
  const Revolution shell{.outer = sphere_contour(2 * r), .inner = sphere_contour(r), .inner_z = -0.5 * r};
  const double volume = 4 * pi / 3 * (r * r * r - r * r * r / 8),
               inertia = 0.4 * r * r * (1 - 1.0 / 32) / (1 - 1.0 / 8);
  expect(shell.mass_properties(), volume, -r, inertia, inertia);
}

} // namespace
} // namespace spall::test
