#include "macro/scene/scene_inputs.h"

#include "macro/setup/run_inputs.h"
#include "shared/error.h"
#include "tests/unit/shared/scratch_folder.h"

#include <numbers>

namespace spall::test {
namespace {

struct Scene {
  SceneInputs physics;
  RunInputs numerics;
  Parameters parameters;
  explicit Scene(const std::filesystem::path& file, const std::vector<std::string>& overrides = {}) {
    physics.declare(parameters);
    numerics.declare(parameters);
    parameters.read(file, overrides);
    physics.validate(file.string());
  }
};

const std::filesystem::path scenes = SPALL_DATA "/scenes";

TEST(SceneInputs, EverySceneOfTheDataFolderIsAccepted) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(scenes)) {
    if (entry.path().extension() != ".prm") continue;
    ++count;
    EXPECT_NO_THROW(Scene{entry.path()}) << entry.path();
  }
  EXPECT_GE(count, 3);
}

// The paper's slabs have about 47,000, 67,000 and 77,000 points, the finest one 152,000; its Taylor bars
// 22,000.
TEST(SceneInputs, TheScenesHaveTheResolutionOfThePaper) {
  const auto whole = [](const char* name) {
    const Scene s(scenes / name);
    return static_cast<double>(make_points(s.physics).owned) * s.physics.planes().multiplicity();
  };
  EXPECT_EQ(whole("slab_127.prm"), 46400);
  EXPECT_EQ(whole("slab_127_fine.prm"), 151788);
  EXPECT_EQ(whole("slab_216.prm"), 66384);
  EXPECT_EQ(whole("slab_254.prm"), 77448);
  EXPECT_EQ(whole("taylor_aluminium.prm"), 19344);
  EXPECT_EQ(whole("taylor_steel.prm"), 19344);
}

TEST(SceneInputs, ATaylorBarFliesTowardsTheWallAndStartsOnIt) {
  const Scene s(scenes / "taylor_aluminium.prm", {"Body/Rings=3", "Body/Layers=8"});
  const Points points = make_points(s.physics);
  double mass = 0, low = 1e9;
  for (std::size_t i = 0; i < points.owned; ++i) {
    EXPECT_EQ(points.velocity[i], (Vec3{0, 0, -373}));
    mass += points.mass[i];
    low = std::min(low, points.position[i][2]);
  }
  EXPECT_NEAR(mass, 2700 * std::numbers::pi * 3.81e-3 * 3.81e-3 * 23.47e-3 / 4, 1e-12);
  EXPECT_EQ(low, 0);
  const RigidBody wall = make_rigid_body(s.physics);
  EXPECT_TRUE(std::holds_alternative<PlaneWall>(wall.shape));
  EXPECT_TRUE(std::isinf(wall.mass));
  EXPECT_EQ(wall.velocity, Vec3{});
}

TEST(SceneInputs, TheProjectileOfAQuarterSlabIsAQuarterProjectileWithItsTipAtTheSurface) {
  const Scene quarter(scenes / "slab_127.prm", {"Body/Rings=4", "Body/Layers=2"}),
      full(scenes / "slab_127.prm", {"Body/Rings=4", "Body/Layers=2", "Scene/Symmetry planes="});
  const RigidBody a = make_rigid_body(quarter.physics), b = make_rigid_body(full.physics);
  EXPECT_EQ(4 * a.mass, b.mass);
  EXPECT_EQ(b.velocity, (Vec3{0, 0, 313}));
  const Revolution& ogive = std::get<Revolution>(b.shape);
  EXPECT_NEAR(2 * ogive.outer.largest_radius(), 50.8e-3, 1e-15);
  EXPECT_NEAR(ogive.length(), 355.6e-3, 1e-15);
  EXPECT_NEAR(full.physics.projectile.projectile().nose_length(), 84.2e-3, 0.1e-3);
  // No point of the slab is inside the projectile at the start.
  const Points points = make_points(full.physics);
  for (std::size_t i = 0; i < points.owned; ++i) {
    EXPECT_GE(ogive.surface(points.position[i]).distance, 0);
    EXPECT_EQ(points.velocity[i], Vec3{});
  }
}

TEST(SceneInputs, SymmetryPlanesAreThoseNamed) {
  const auto planes = [](const std::string& words) {
    return Scene(scenes / "taylor_steel.prm", {"Scene/Symmetry planes=" + words}).physics.planes().normal;
  };
  EXPECT_EQ(planes(""), (std::array{false, false, false}));
  EXPECT_EQ(planes("x"), (std::array{true, false, false}));
  EXPECT_EQ(planes("y"), (std::array{false, true, false}));
  EXPECT_EQ(planes("y, x"), (std::array{true, true, false}));
}

TEST(SceneInputs, WhatNoSingleKeyCanSeeIsRefused) {
  const auto refusal = [](const char* scene, const std::vector<std::string>& overrides) {
    return message_of<InputError>([&] { Scene(scenes / scene, overrides); });
  };
  expect_one_line_with(refusal("slab_127.prm", {"Projectile/Length=80 mm"}),
                       {"slab_127.prm", "Projectile/Length"});
  expect_one_line_with(refusal("taylor_steel.prm", {"Body/Layers=1"}), {"taylor_steel.prm", "Body/Layers"});
  expect_one_line_with(refusal("taylor_steel.prm", {"Body/Rings=0"}), {"taylor_steel.prm", "Body/Rings"});
}

TEST(SceneInputs, AGradedSpacingExcludesWhatContradictsIt) {
  const auto with = [](std::vector<std::string> more) {
    for (const char* graded : {"Body/Rings=0", "Body/Layers=0", "Body/Fine spacing=8 mm",
                               "Body/Fine radius=60 mm", "Body/Coarse spacing=16 mm"})
      more.insert(more.begin(), graded);
    return more;
  };
  const auto refusal = [&](const std::vector<std::string>& more) {
    return message_of<InputError>([&] { Scene(scenes / "slab_127.prm", with(more)); });
  };
  EXPECT_NO_THROW(Scene(scenes / "slab_127.prm", with({})));
  expect_one_line_with(refusal({"Body/Rings=43"}),
                       {"Body/Fine spacing", "0.008 m", "Rings and Layers (43, 0)"});
  expect_one_line_with(refusal({"Body/Layout=lattice"}), {"Body/Layout", "0.008 m", "polar"});
  expect_one_line_with(refusal({"Body/Coarse spacing=7 mm"}), {"Body/Coarse spacing", "0.007 m", "0.008 m"});
  expect_one_line_with(refusal({"Body/Coarse spacing=64 mm"}), {"Body/Coarse spacing", "0.0635 m"});
  expect_one_line_with(
      message_of<InputError>([] {
        Scene(scenes / "slab_127.prm", {"Body/Rings=0", "Body/Layers=0", "Body/Fine spacing=8 mm"});
      }),
      {"Body/Fine radius"});
}

TEST(SceneInputs, KeysAreMissedOnlyWhereTheyAreNeeded) {
  const ScratchFolder folder;
  const std::string taylor = "include " + (scenes / "../materials/copper.prm").string() +
                             "\nsubsection Scene\nset Kind = taylor\nset Impact velocity = 227 m/s\nend\n"
                             "subsection Body\nset Diameter = 6.4 mm\nset Height = 32.4 mm\n"
                             "set Rings = 3\nset Layers = 30\nend\n";
  const std::string end = "subsection Time\nset End time = 80 us\nend\n";
  EXPECT_NO_THROW(Scene(folder.write("taylor.prm", taylor + end))); // no projectile, no concrete
  expect_one_line_with(message_of<InputError>([&] { Scene(folder.write("endless.prm", taylor)); }),
                       {"Time/End time"});
  expect_one_line_with(
      message_of<InputError>([&] {
        Scene(folder.write("slab.prm", taylor + end + "subsection Scene\nset Kind = slab\nend\n"));
      }),
      {"slab.prm", "Projectile/"});
  expect_one_line_with(
      message_of<InputError>([&] {
        Scene(folder.write("concrete.prm", taylor + end + "subsection Material\nset Law = AFC\nend\n"));
      }),
      {"concrete.prm", "AFC/"});
}

} // namespace
} // namespace spall::test
