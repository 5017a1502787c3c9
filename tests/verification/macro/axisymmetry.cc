// Tests of rotational symmetry, where points of a half plane represent the body.

#include "tests/verification/macro/aluminium_bar.h"

#include <gtest/gtest.h>

namespace spall::test {
namespace {

class Axisymmetry : public ::testing::TestWithParam<Scheme> {};

TEST_P(Axisymmetry, StretchAlongAndAcrossTheAxisStrainsAllPointsAlike) {
  // For v = (a x, a y, b z) radial and hoop strain rates are equal, and the strain rates are uniform, also
  // next to the axis.
  const J2 material = elastic();
  const SymmetryPlanes planes{.axis = true};
  Points points =
      fill_cylinder({.radius = 0.05, .height = 0.05, .bottom = 0}, {8, 8, Boundary::centred}, planes, 2700);
  const double a = 3, b = -2, dt = 1e-6;
  set_velocity(points, [&](const Vec3& x) { return Vec3{a * x[0], 0, b * x[2]}; });
  const auto solid = make_solid(material, std::move(points), planes, Numerics{.scheme = GetParam()}.solid());
  solid->refresh();
  solid->update(dt, dt);
  const double bulk = material.bulk_modulus(), shear = material.shear_modulus(), volume = 2 * a + b;
  const double across = dt * (bulk * volume + 2 * shear * (a - volume / 3)),
               along = dt * (bulk * volume + 2 * shear * (b - volume / 3));
  for (std::size_t i = 0; i < solid->points.owned; ++i) {
    const Sym3& s = solid->points.cauchy(i);
    EXPECT_NEAR(s[0], across, 1e-4 * across);
    EXPECT_NEAR(s[1], across, 1e-4 * across);
    EXPECT_NEAR(s[2], along, 1e-4 * across);
    for (int c = 3; c < 6; ++c) EXPECT_NEAR(s[c], 0, 1e-6 * across);
  }
}

INSTANTIATE_TEST_SUITE_P(All, Axisymmetry,
                         ::testing::Values(Scheme::dni, Scheme::nsni, Scheme::snni, Scheme::m_snni,
                                           Scheme::subpoint),
                         scheme_label);

TEST(AxisymmetricBar, HasTheConvergedShapeAndKeepsItsEnergy) {
  const Bar scene = aluminium_bar(10, 62, {"axis"});
  Simulation run = shoot(scene);
  const BarShape bar = shape_at_rebound(run, scene);
  // Axisymmetric finite elements give 0.7040, 16.66 mm, 1.637, 0.4456.
  EXPECT_NEAR(bar.length / scene.height, 0.704, 0.002);
  EXPECT_NEAR(bar.foot_diameter, 16.66e-3, 0.4e-3);
  EXPECT_NEAR(bar.plastic_strain_95, 1.637, 0.03);
  EXPECT_NEAR(bar.mean_plastic_strain, 0.4456, 0.01);
  EXPECT_LT(std::abs(run.energies.error()), 1e-4);
}

TEST(AxisymmetricBar, IsTheBarInThreeDimensions) {
  const Bar rings = aluminium_bar(5, 31, {"axis"}), quarter = aluminium_bar(5, 31, {"x", "y"});
  Simulation a = shoot(rings), b = shoot(quarter);
  until_rebound(a);
  until_rebound(b);
  const BarShape p = shape_of(a), q = shape_of(b);
  std::printf("L/L0 %.4f and %.4f, foot %.2f and %.2f mm\n", p.length / rings.height, q.length / rings.height,
              p.foot_diameter * 1e3, q.foot_diameter * 1e3);
  EXPECT_NEAR(p.length, q.length, 0.003 * rings.height);
  EXPECT_NEAR(p.foot_diameter, q.foot_diameter, 0.03 * q.foot_diameter);
  EXPECT_NEAR(a.energies.initial, 4 * b.energies.initial, 1e-9 * a.energies.initial);
}

TEST(AxisymmetricSlab, ItsProjectileStaysOnTheAxis) {
  const SymmetryPlanes planes{.axis = true};
  for (int c = 0; c < 3; ++c) {
    EXPECT_EQ(planes.moves_along(c), c == 2);
    EXPECT_FALSE(planes.turns_about(c));
  }
}

} // namespace
} // namespace spall::test
