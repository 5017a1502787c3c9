#include "macro/scene/projectile_inputs.h"

#include "macro/scene/scene_inputs.h"
#include "shared/error.h"
#include "tests/unit/shared/scratch_folder.h"

#include <gtest/gtest.h>

#include <numbers>

namespace spall::test {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// The 127 mm slab's projectile.
SceneInputs slab(const std::vector<std::string>& overrides) {
  SceneInputs scene;
  Parameters parameters;
  scene.declare(parameters);
  const ScratchFolder folder;
  const std::string text = std::string("include ") + SPALL_DATA + "/materials/wes5000.prm\ninclude " +
                           SPALL_DATA +
                           "/materials/sap_projectile.prm\nsubsection Scene\nset Kind = slab\n"
                           "set Impact velocity = 313 m/s\nend\nsubsection Body\nset Diameter = 1 m\n"
                           "set Height = 127 mm\nset Rings = 10\nset Layers = 8\nend\n";
  const auto file = folder.write("slab.prm", text);
  parameters.read(file, overrides);
  scene.validate(file.string());
  return scene;
}
RigidBody projectile(const std::vector<std::string>& overrides) { return make_rigid_body(slab(overrides)); }

TEST(ProjectileInputs, FliesAlongTheObliquityWithItsAxisAtTheAngleOfAttack) {
  const RigidBody body = projectile({"Scene/Obliquity=30 deg", "Scene/Angle of attack=-5 deg"});
  EXPECT_NEAR(body.velocity[0], 313 * 0.5, 1e-9);
  EXPECT_EQ(body.velocity[1], 0);
  EXPECT_NEAR(body.velocity[2], 313 * std::cos(30 * degree), 1e-9);
  const Vec3 axis = times(matrix_of(body.orientation), {0, 0, 1});
  EXPECT_NEAR(std::atan2(axis[0], axis[2]), 25 * degree, 1e-12);
  EXPECT_EQ(body.angular_velocity(), Vec3{});
}

TEST(ProjectileInputs, ItsForemostPointIsTheStartGapBeforeTheSlab) {
  for (const char* angle : {"0 deg", "20 deg", "-75 deg"}) {
    const RigidBody body = projectile({std::string("Scene/Obliquity=") + angle, "Contact/Start gap=3 mm"});
    EXPECT_NEAR(body.front(), -3e-3, 1e-15) << angle;
    EXPECT_LT(body.rear(), body.front() - 0.05) << angle;
  }
}

TEST(ProjectileInputs, SymmetryPlanesTakeAwayTheMotionsThatWouldLeaveThem) {
  const RigidBody whole = projectile({}), half = projectile({"Scene/Symmetry planes=y"}),
                  quarter = projectile({"Scene/Symmetry planes=x, y"});
  EXPECT_EQ(whole.free, (std::array{true, true, true}));
  EXPECT_EQ(whole.turns, (std::array{true, true, true}));
  EXPECT_EQ(half.free, (std::array{true, false, true}));
  EXPECT_EQ(half.turns, (std::array{false, true, false}));
  EXPECT_EQ(quarter.free, (std::array{false, false, true}));
  EXPECT_FALSE(quarter.can_turn());
  EXPECT_EQ(2 * half.mass, whole.mass);
  for (int c = 0; c < 3; ++c) EXPECT_EQ(2 * half.moments[c], whole.moments[c]);
}

TEST(ProjectileInputs, MomentsAreThoseOfAHomogeneousBodyUnlessGiven) {
  const RigidBody body = projectile({});
  // Nearly a cylinder of the same mass that lacks half of its nose.
  const double r = 0.0254, shorter = 0.3556 - 0.5 * 0.0842;
  EXPECT_NEAR(body.moments[2], 2.34 * r * r / 2, 0.1 * body.moments[2]);
  EXPECT_NEAR(body.moments[0], 2.34 * shorter * shorter / 12, 0.1 * body.moments[0]);
  EXPECT_EQ(body.moments[0], body.moments[1]);
  EXPECT_NEAR(body.centre[2], -0.3556 + 0.5 * shorter, 0.01);
  const RigidBody given =
      projectile({"Projectile/Centre of mass=0.2 m", "Projectile/Axial moment=0.001 kg m2",
                  "Projectile/Transverse moment=0.03 kg m2"});
  EXPECT_EQ(given.centre[2], -0.2);
  EXPECT_EQ(given.moments, (Vec3{0.03, 0.03, 0.001}));
}

/// The slab's projectile as a casing.
const std::vector<std::string> casing = {
    "Projectile/Model=deformable",        "Projectile/Nose thickness=25.4 mm",
    "Projectile/Base thickness=12.7 mm",  "Projectile/Young's modulus=205 GPa",
    "Projectile/Poisson's ratio=0.26",    "Projectile/Yield stress=1750 MPa",
    "Projectile/Hardening modulus=1 GPa", "Projectile/Density=11248 kg/m3"};
std::vector<std::string> with_casing(const std::vector<std::string>& more) {
  std::vector<std::string> all = casing;
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

TEST(ProjectileInputs, ACasingHasTheMassAndTheMetalThatItsDensityMakes) {
  const SceneInputs scene = slab(with_casing({"Projectile/Layers=78"}));
  const ProjectileInputs& p = scene.projectile;
  const Points points = p.fill({}, scene.flight());
  double mass = 0, metal = 0;
  for (std::size_t i = 0; i < points.owned; ++i) mass += points.mass[i], metal += points.volume[i];
  EXPECT_NEAR(mass, 2.34, 1e-9);
  EXPECT_NEAR(metal, 208.0e-6, 0.1e-6);
  EXPECT_NEAR(p.wall_thickness(), 3.5e-3, 0.5e-3);
  EXPECT_NEAR(static_cast<double>(points.owned), 4825, 0.03 * 4825); // the paper's
  // A heavier casing has a thicker wall.
  const SceneInputs heavy = slab(with_casing({"Projectile/Mass=3 kg"}));
  EXPECT_GT(heavy.projectile.wall_thickness(), 1.3 * p.wall_thickness());
}

TEST(ProjectileInputs, ADeformableProjectileFliesAsTheRigidOneWould) {
  const SceneInputs scene = slab(with_casing({"Scene/Obliquity=20 deg", "Scene/Angle of attack=5 deg"}));
  const ProjectileInputs& p = scene.projectile;
  const Points points = p.fill(scene.planes(), scene.flight());
  const RigidBody rigid = p.rigid_body(scene.planes(), scene.flight());
  const KnownSurface surface = p.surface(scene.planes(), scene.flight(), points);
  EXPECT_TRUE(std::holds_alternative<Nothing>(make_rigid_body(scene).shape));
  for (std::size_t i = 0; i < points.owned; ++i) {
    EXPECT_EQ(points.velocity[i], rigid.velocity);
    EXPECT_LT(surface.at(points.position[i]).distance, 0);
    EXPECT_LT(points.position[i][2], 0);
  }
  EXPECT_NEAR(surface.at(rigid.position).distance, 0, 1e-15);
}

TEST(ProjectileInputs, WhatCannotBeIsRefused) {
  const auto refusal = [](const std::vector<std::string>& overrides) {
    return message_of<InputError>([&] { slab(overrides); });
  };
  expect_one_line_with(refusal({"Scene/Obliquity=10 deg", "Scene/Symmetry planes=x, y"}),
                       {"slab.prm", "Scene/Symmetry planes", "Scene/Obliquity", "none or y"});
  expect_one_line_with(refusal({"Scene/Angle of attack=1 deg", "Scene/Symmetry planes=x"}),
                       {"slab.prm", "Scene/Symmetry planes"});
  expect_one_line_with(refusal({"Projectile/Centre of mass=0.4 m"}),
                       {"slab.prm", "Projectile/Centre of mass"});
  expect_one_line_with(
      refusal({"Projectile/Axial moment=0.1 kg m2", "Projectile/Transverse moment=0.01 kg m2"}),
      {"slab.prm", "Projectile/Transverse moment"});
}

} // namespace
} // namespace spall::test
