// Tests of the inputs of one body of a scene: its place, attitude, mass and points.

#include "macro/contact/carried_surface.h"
#include "shared/error.h"
#include "tests/support/scenes.h"
#include "tests/unit/shape/stl.h"

#include <gtest/gtest.h>

#include <numbers>

namespace spall::test {
namespace {

constexpr double degree = std::numbers::pi / 180;
using Words = std::vector<std::string>;

/// Reads the whole 127 mm slab at a coarse resolution, with overrides.
std::shared_ptr<SceneFile> slab(const Words& overrides, const std::string& scene = "slab_127.prm") {
  Words all = {"Scene/Symmetry planes=", "slab/Diameter=1 m", "slab/Rings=10", "slab/Layers=8"};
  all.insert(all.end(), overrides.begin(), overrides.end());
  return shipped(scene, all);
}
RigidBody projectile(const Words& overrides) {
  const auto file = slab(overrides);
  return file->scene.find("projectile")
      ->rigid_body(file->scene.planes(), place_bodies(file->scene, "scene").at("projectile").origin);
}
Points casing(const SceneFile& file) { return make_points(file.scene, "projectile"); }

TEST(BodyInputs, AProjectileFliesAlongTheObliquityWithItsAxisAtTheAngleOfAttack) {
  const RigidBody body = projectile({"projectile/Obliquity=30 deg", "projectile/Angle of attack=-5 deg"});
  EXPECT_NEAR(body.velocity[0], 313 * 0.5, 1e-9);
  EXPECT_EQ(body.velocity[1], 0);
  EXPECT_NEAR(body.velocity[2], 313 * std::cos(30 * degree), 1e-9);
  const Vec3 axis = times(matrix_of(body.orientation), {0, 0, 1});
  EXPECT_NEAR(std::atan2(axis[0], axis[2]), 25 * degree, 1e-12);
  EXPECT_EQ(body.angular_velocity(), Vec3{});
}

TEST(BodyInputs, SpinTurnsABodyAboutItsAxis) {
  const double spin = 200; // rad/s
  const Words at_an_angle = {"projectile/Obliquity=30 deg", "projectile/Spin=200 rad/s"};
  const RigidBody body = projectile(at_an_angle);
  const Vec3 axis = times(matrix_of(body.orientation), {0, 0, 1});
  EXPECT_LT(norm(body.angular_velocity() - spin * axis), 1e-9 * spin);
  EXPECT_NEAR(body.kinetic_energy(), 0.5 * body.mass * 313 * 313 + 0.5 * body.moments[2] * spin * spin, 1e-6);

  Words deformable = {"projectile/Model=deformable",
                      "projectile/Material/Law=J2",
                      "projectile/Rings=3",
                      "projectile/Layers=40",
                      "projectile/J2/Young's modulus=200 GPa",
                      "projectile/J2/Poisson's ratio=0.3",
                      "projectile/J2/Yield stress=1 GPa",
                      "projectile/J2/Hardening modulus=0 GPa",
                      "projectile/J2/Density=7850 kg/m3"};
  deformable.insert(deformable.end(), at_an_angle.begin(), at_an_angle.end());
  const Points points = casing(*slab(deformable));
  ASSERT_GT(points.owned, 100u);
  const Vec3 flight = 313 * Vec3{0.5, 0, std::cos(30 * degree)};
  for (std::size_t i = 0; i < points.owned; ++i) {
    const Vec3 turning = points.velocity[i] - flight;
    EXPECT_NEAR(dot(turning, axis), 0, 1e-9);
    EXPECT_LT(norm(turning), 1.01 * spin * 0.0254);
  }
}

TEST(BodyInputs, ABodyDoesNotSpinAcrossAPlaneOfSymmetryOrWhereItIsHeld) {
  EXPECT_THROW(slab({"projectile/Spin=200 rad/s", "Scene/Symmetry planes=y"}), InputError);
  EXPECT_THROW(slab({"projectile/Spin=200 rad/s", "projectile/Held=yes", "projectile/Velocity=0 m/s"}),
               InputError);
  EXPECT_NO_THROW(slab({"projectile/Spin=200 rad/s"}));
}

TEST(BodyInputs, TheForemostPointOfAProjectileIsTheGapBeforeTheSlab) {
  for (const char* angle : {"0 deg", "20 deg", "-75 deg"}) {
    const RigidBody body = projectile({std::string("projectile/Obliquity=") + angle, "projectile/Gap=3 mm"});
    EXPECT_NEAR(body.front(), -3e-3, 1e-15) << angle;
    EXPECT_LT(body.rear(), body.front() - 0.05) << angle;
  }
}

TEST(BodyInputs, SymmetryPlanesConstrainTheMotion) {
  const RigidBody whole = projectile({}), half = projectile({"Scene/Symmetry planes=y"}),
                  quarter = projectile({"Scene/Symmetry planes=x, y"});
  EXPECT_EQ(whole.free, (std::array{true, true, true}));
  EXPECT_EQ(whole.turns, (std::array{true, true, true}));
  EXPECT_EQ(half.free, (std::array{true, false, true}));
  EXPECT_EQ(half.turns, (std::array{false, true, false}));
  EXPECT_EQ(quarter.free, (std::array{false, false, true}));
  EXPECT_FALSE(quarter.can_turn());
  EXPECT_EQ(2 * half.mass, whole.mass);
  EXPECT_EQ(4 * quarter.mass, whole.mass);
  for (int c = 0; c < 3; ++c) EXPECT_EQ(2 * half.moments[c], whole.moments[c]);
}

TEST(BodyInputs, MomentsAreThoseOfAHomogeneousBodyUnlessGiven) {
  const RigidBody body = projectile({});
  // The moments are nearly those of a cylinder of the same mass that is half of the nose shorter.
  const double r = 0.0254, shorter = 0.3556 - 0.5 * 0.0842;
  EXPECT_NEAR(body.moments[2], 2.34 * r * r / 2, 0.1 * body.moments[2]);
  EXPECT_NEAR(body.moments[0], 2.34 * shorter * shorter / 12, 0.1 * body.moments[0]);
  EXPECT_EQ(body.moments[0], body.moments[1]);
  EXPECT_NEAR(body.centre[2], -0.3556 + 0.5 * shorter, 0.01);
  const RigidBody given =
      projectile({"projectile/Centre of mass=0.2 m", "projectile/Axial moment=0.001 kg m2",
                  "projectile/Transverse moment=0.03 kg m2"});
  EXPECT_EQ(given.centre[2], -0.2);
  EXPECT_EQ(given.moments, (Vec3{0.03, 0.03, 0.001}));
}

TEST(BodyInputs, TheMassOfARigidBodyFollowsFromItsMeanDensityToo) {
  const RigidBody steel =
      projectile({"projectile/Shape=sphere", "projectile/Diameter=20 mm", "projectile/Mass=1 kg"});
  EXPECT_EQ(steel.mass, 1);
  const auto file =
      written("subsection ball\n  set Model = rigid\n  set Shape = sphere\n  set Diameter = 20 mm\n"
              "  set Mean density = 7800 kg/m3\n  set Before = slab\nend\n"
              "subsection slab\n  include data/materials/wes5000.prm\n  set Shape = cylinder\n"
              "  set Diameter = 0.2 m\n  set Height = 50 mm\n  set Rings = 4\n  set Layers = 2\nend\n"
              "subsection Time\n  set End time = 1 ms\nend\n");
  const RigidBody ball = file->scene.find("ball")->rigid_body({}, {});
  const double mass = 7800 * 4 / 3. * std::numbers::pi * 1e-6;
  EXPECT_NEAR(ball.mass, mass, 1e-9 * mass);
  for (const double moment : ball.moments) EXPECT_NEAR(moment, 0.4 * mass * 1e-4, 1e-9 * mass * 1e-4);
  EXPECT_NEAR(ball.centre[2], -10e-3, 1e-12);
}

/// The whole 127 mm slab with a projectile from a file of triangles.
class FromTriangles : public ::testing::Test {
protected:
  Words keys(const Triangles& triangles, Words more = {}) {
    write_stl(folder / "shot.stl", triangles, 1e-3);
    more.insert(more.end(), {"projectile/Shape=surface", "projectile/Unit=mm",
                             "projectile/File=" + (folder / "shot.stl").string()});
    return more;
  }
  static Triangles ogive() {
    const Contour contour = Projectile{.diameter = 0.0508,
                                       .length = 0.3556,
                                       .nose = {.kind = NoseKind::ogive, .caliber_radius_head = 3}}
                                .contour();
    return turned_surface(contour.outline(2e-3), 48);
  }
  std::string refusal(const Triangles& triangles, const Words& more) {
    return message_of<InputError>([&] { slab(keys(triangles, more)); });
  }
  ScratchFolder folder;
};

TEST_F(FromTriangles, ARigidBodyHasTheInertiaOfTheRoundOne) {
  const Words whole = {"projectile/Obliquity=20 deg"};
  const RigidBody round = projectile(whole), body = projectile(keys(ogive(), whole));
  EXPECT_EQ(body.mass, round.mass);
  EXPECT_NEAR(body.front(), round.front(), 1e-5);
  EXPECT_NEAR(body.centre[2], round.centre[2], 1e-4);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(body.moments[c], round.moments[c], 0.01 * round.moments[c]);
}

TEST_F(FromTriangles, ASurfaceThatLacksTheSymmetryOfTheSceneIsRefused) {
  Triangles shifted = ogive();
  for (Vec3& x : shifted.points) x[0] += 2e-3;
  EXPECT_NO_THROW(slab(keys(shifted)));
  EXPECT_NO_THROW(slab(keys(shifted, {"Scene/Symmetry planes=y"})));
  expect_one_line_with(refusal(shifted, {"Scene/Symmetry planes=x, y"}),
                       {"projectile/File", "plane x = 0", "found 0.00", "allowed: 0.0005"});
  expect_one_line_with(refusal(ogive(), {"Scene/Symmetry planes=axis"}), {"projectile/Shape", "axis"});
}

TEST_F(FromTriangles, MassPropertiesThatFollowFromTheSurfaceAreNotAskedFor) {
  expect_one_line_with(refusal(ogive(), {"projectile/Axial moment=0.001 kg m2"}),
                       {"projectile/Axial moment"});
}

TEST(BodyInputs, ACasingHasTheMassAndTheMetalThatItsDensityMakes) {
  const auto file = slab({}, "slab_127_deformable.prm");
  const Points points = casing(*file);
  double mass = 0, metal = 0;
  for (std::size_t i = 0; i < points.owned; ++i) mass += points.mass[i], metal += points.volume[i];
  EXPECT_NEAR(mass, 2.34, 1e-9);
  EXPECT_NEAR(metal, 208.0e-6, 0.1e-6);
  EXPECT_NEAR(static_cast<double>(points.owned), 4825, 0.03 * 4825); // the number in the paper
  // A heavier casing has a thicker wall.
  const Points heavy = casing(*slab({"projectile/Mass=3 kg"}, "slab_127_deformable.prm"));
  double more = 0;
  for (const double volume : heavy.volume) more += volume;
  EXPECT_NEAR(more, 3 / 11248., 1e-9);
}

TEST(BodyInputs, ADeformableProjectileFliesAsTheRigidOneWould) {
  const Words oblique = {"projectile/Obliquity=20 deg", "projectile/Angle of attack=5 deg"};
  const auto file = slab(oblique, "slab_127_deformable.prm");
  const RigidBody rigid = projectile(oblique);
  const Points points = casing(*file);
  const KnownSurface surface =
      known_surface(rigid.shape, matrix_of(rigid.orientation), rigid.position, points);
  for (std::size_t i = 0; i < points.owned; ++i) {
    EXPECT_EQ(points.velocity[i], rigid.velocity);
    EXPECT_LT(surface.at(points.position[i]).distance, 0);
    EXPECT_LT(points.position[i][2], 0);
  }
  EXPECT_NEAR(surface.at(rigid.position).distance, 0, 1e-15);
}

TEST(BodyInputs, ImpossibleCombinationsAreRefused) {
  const auto refusal = [](const Words& overrides) {
    return message_of<InputError>([&] { slab(overrides); });
  };
  expect_one_line_with(refusal({"projectile/Obliquity=10 deg", "Scene/Symmetry planes=x, y"}),
                       {"slab_127.prm", "Scene/Symmetry planes", "projectile/Obliquity", "none or y"});
  expect_one_line_with(refusal({"projectile/Angle of attack=1 deg", "Scene/Symmetry planes=x"}),
                       {"slab_127.prm", "Scene/Symmetry planes"});
  expect_one_line_with(refusal({"projectile/Centre of mass=0.4 m"}),
                       {"slab_127.prm", "projectile/Centre of mass"});
  expect_one_line_with(
      refusal({"projectile/Axial moment=0.001 kg m2", "projectile/Transverse moment=0.0001 kg m2"}),
      {"slab_127.prm", "projectile/Transverse moment"});
  expect_one_line_with(refusal({"projectile/Offset x=5 mm", "Scene/Symmetry planes=x"}),
                       {"slab_127.prm", "projectile/Offset x"});
  expect_one_line_with(refusal({"projectile/Held=yes"}), {"slab_127.prm", "projectile/Velocity"});
  expect_one_line_with(refusal({"projectile/Mean density=7800 kg/m3"}), {"slab_127.prm", "projectile/Mass"});
}

TEST(BodyInputs, SupportsThatMakeNoSenseAreRefused) {
  const std::vector<std::pair<std::string, Words>> cases = {
      {"slab/Supports", {"slab/Supports=clamped", "slab/Velocity=1 m/s"}},
      {"slab/Supports", {"slab/Supports=simple", "slab/Obliquity=1 deg"}},
      {"projectile/Supports", {"projectile/Supports=clamped"}},
      {"slab/Support diameter", {"slab/Support diameter=0.5 m"}},
      {"slab/Support diameter", {"slab/Supports=clamped", "slab/Support diameter=0.5 m"}}};
  for (const auto& [key, words] : cases) {
    try {
      slab(words);
      ADD_FAILURE() << "accepted: " << words.back();
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("key '" + key + "'"), std::string::npos) << error.what();
    }
  }
  EXPECT_NO_THROW(slab({"slab/Supports=simple", "slab/Support diameter=0.5 m"}));
}

} // namespace
} // namespace spall::test
