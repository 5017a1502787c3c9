// Tests of scene files: their bodies, and the inputs that are refused.

#include "shared/error.h"
#include "tests/support/scenes.h"

#include <gtest/gtest.h>

#include <numbers>

namespace spall::test {
namespace {

/// Returns the text of a scene with a concrete slab of 0.2 m, followed by `more`.
std::string with_slab(const std::string& more) {
  return "subsection slab\n  include data/materials/wes5000.prm\n  set Shape = cylinder\n  set Diameter = "
         "0.2 m\n"
         "  set Height = 50 mm\n  set Rings = 4\n  set Layers = 2\nend\n"
         "subsection Time\n  set End time = 1 ms\nend\n" +
         more;
}
const std::string ball =
    "subsection ball\n  set Model = rigid\n  set Shape = sphere\n  set Diameter = 20 mm\n"
    "  set Mass = 30 g\n  set Before = slab\n  set Velocity = 100 m/s\nend\n";

std::string refusal_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return message_of<InputError>([&] { written(text, overrides); });
}
std::string refusal_by(const std::string& scene, const std::vector<std::string>& overrides) {
  return message_of<InputError>([&] { shipped(scene, overrides); });
}

TEST(SceneInputs, EverySceneOfTheDataFolderIsAccepted) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(SPALL_DATA "/scenes")) {
    if (entry.path().extension() != ".prm") continue;
    ++count;
    EXPECT_NO_THROW(SceneFile(entry.path(), {})) << entry.path();
  }
  EXPECT_GE(count, 20);
}

// The paper's slabs have about 47,000, 67,000 and 77,000 points, the finest one 152,000; its Taylor bars
// 22,000.
TEST(SceneInputs, TheScenesHaveTheResolutionOfThePaper) {
  const auto whole = [](const char* name, const char* body) {
    const auto file = shipped(name);
    return static_cast<double>(make_points(file->scene, body).owned) * file->scene.planes().multiplicity();
  };
  EXPECT_EQ(whole("slab_127.prm", "slab"), 46400);
  EXPECT_EQ(whole("slab_127_fine.prm", "slab"), 151788);
  EXPECT_EQ(whole("slab_216.prm", "slab"), 66384);
  EXPECT_EQ(whole("slab_254.prm", "slab"), 77448);
  EXPECT_EQ(whole("taylor_aluminium.prm", "bar"), 19344);
  EXPECT_EQ(whole("taylor_steel.prm", "bar"), 19344);
}

TEST(SceneInputs, EverySectionThatIsNotTheProgramsOwnIsABodyInTheOrderOfTheFile) {
  const auto file = written(with_slab(ball));
  ASSERT_EQ(file->scene.bodies.size(), 2u);
  EXPECT_EQ(file->scene.bodies[0].name, "slab");
  EXPECT_EQ(file->scene.bodies[1].name, "ball");
  EXPECT_EQ(file->scene.find("ball"), &file->scene.bodies[1]);
  EXPECT_EQ(file->scene.find("bat"), nullptr);
}

TEST(SceneInputs, ABodyMayBeLeftOut) {
  const auto file = written(with_slab(ball), {"ball/Model=none"});
  EXPECT_EQ(file->scene.find("ball"), nullptr);
}

TEST(SceneInputs, ANameThatIsUsedTwiceIsRefused) {
  expect_one_line_with(refusal_of(with_slab(ball + "subsection ball\n  set Offset x = 1 mm\nend\n")),
                       {"scene.prm:20", "'ball'", "a second time", "line 12"});
  expect_one_line_with(refusal_of(with_slab("subsection Slab\nend\n")), {"'Slab'", "'slab'", "capitals"});
}

TEST(SceneInputs, AFileMayChangeTheBodiesOfAFileThatItIncludes) {
  const auto file =
      written("include data/scenes/slab_127.prm\nsubsection slab\n  set Height = 100 mm\nend\n");
  EXPECT_EQ(file->scene.find("slab")->shape.height, 0.1);
}

TEST(SceneInputs, ABodyWithoutMaterialIsRefused) {
  expect_one_line_with(
      refusal_of("subsection slab\n  set Shape = cylinder\n  set Diameter = 0.2 m\n  set Height = 50 mm\n"
                 "  set Rings = 4\n  set Layers = 2\nend\nsubsection Time\nset End time = 1 s\nend\n",
                 {}),
      {"scene.prm", "'slab'"});
}

TEST(SceneInputs, ASceneWithoutDeformableBodyIsRefused) {
  expect_one_line_with(refusal_of("subsection Time\n  set End time = 1 ms\nend\n"),
                       {"scene.prm", "deformable"});
}

TEST(SceneInputs, AnAnswerAboutABodyThatIsNotThereIsRefused) {
  const auto asking = [](const std::string& question) {
    return with_slab(ball + "subsection Answers\n  set " + question + "\nend\n");
  };
  EXPECT_NO_THROW(written(asking("Exit = ball through slab")));
  EXPECT_NO_THROW(written(asking("Penetration = ball into slab")));
  for (const auto& [question, word] :
       {std::pair("Exit = bullet through slab", "'bullet'"), std::pair("Exit = ball through wall", "'wall'"),
        std::pair("Exit = slab through ball", "'ball'"), std::pair("Exit = ball", "BODY through BODY"),
        std::pair("Length = slab", "does not move"), std::pair("Momentum = ball", "'ball'"),
        std::pair("Penetration = ball through slab", "BODY into BODY")})
    expect_one_line_with(refusal_of(asking(question)), {"scene.prm", "Answers/", word});
  expect_one_line_with(refusal_of(asking("Exit = ball through slab"), {"ball/Model=none"}), {"'ball'"});
}

TEST(SceneInputs, BodiesThatOverlapAreRefused) {
  const auto with_ball = [](const std::string& place) {
    return written(with_slab(ball), {"ball/Before=", place});
  };
  EXPECT_NO_THROW(with_ball("ball/Lowest point=-20 mm"));
  EXPECT_NO_THROW(with_ball("ball/Lowest point=50 mm"));
  for (const char* place : {"ball/Lowest point=-19 mm", "ball/Lowest point=49 mm", "ball/Lowest point=10 mm"})
    expect_one_line_with(message_of<InputError>([&] { with_ball(place); }),
                         {"scene.prm", "'slab'", "'ball'", "overlap"});
}

TEST(SceneInputs, BodiesStandBehindAndBeforeEachOther) {
  const auto file = written(with_slab(ball), {"ball/Gap=3 mm"});
  const auto places = place_bodies(file->scene, "scene");
  EXPECT_EQ(places.at("slab").lowest, 0);
  EXPECT_NEAR(places.at("slab").highest, 50e-3, 1e-15);
  EXPECT_NEAR(places.at("ball").highest, -3e-3, 1e-15);
  EXPECT_NEAR(places.at("ball").lowest, -23e-3, 1e-15);
  const auto behind = written(with_slab(ball), {"ball/Before=", "ball/Behind=slab", "ball/Gap=3 mm"});
  EXPECT_NEAR(place_bodies(behind->scene, "scene").at("ball").lowest, 53e-3, 1e-15);
}

TEST(SceneInputs, PlacesThatReferToNothingOrToThemselvesAreRefused) {
  const std::string text = with_slab(ball);
  expect_one_line_with(refusal_of(text, {"ball/Before=plate"}), {"ball/Before", "'plate'"});
  expect_one_line_with(refusal_of(text, {"slab/Behind=ball"}), {"itself"});
  expect_one_line_with(refusal_of(text, {"ball/Behind=slab"}), {"ball/Before", "either"});
}

TEST(SceneInputs, ATaylorBarFliesTowardsTheWallAndStartsOnIt) {
  const auto file = shipped("taylor_aluminium.prm", {"bar/Rings=3", "bar/Layers=8"});
  const Points points = make_points(file->scene, "bar");
  double mass = 0, low = 1e9;
  for (std::size_t i = 0; i < points.owned; ++i) {
    EXPECT_EQ(points.velocity[i], (Vec3{0, 0, -373}));
    mass += points.mass[i];
    low = std::min(low, points.position[i][2]);
  }
  EXPECT_NEAR(mass, 2700 * std::numbers::pi * 3.81e-3 * 3.81e-3 * 23.47e-3 / 4, 1e-12);
  EXPECT_EQ(low, 0);
  const Simulation run = start(*file);
  const RigidBody& wall = run.bodies.rigids.at(0);
  EXPECT_EQ(wall.name, "wall");
  EXPECT_TRUE(std::holds_alternative<PlaneWall>(wall.shape));
  EXPECT_TRUE(wall.held());
  EXPECT_EQ(wall.position, Vec3{});
}

TEST(SceneInputs, SymmetryPlanesAreThoseNamed) {
  const auto planes = [](const std::string& words) {
    return shipped("taylor_steel.prm", {"Scene/Symmetry planes=" + words})->scene.planes().normal;
  };
  EXPECT_EQ(planes(""), (std::array{false, false, false}));
  EXPECT_EQ(planes("x"), (std::array{true, false, false}));
  EXPECT_EQ(planes("y"), (std::array{false, true, false}));
  EXPECT_EQ(planes("y, x"), (std::array{true, true, false}));
  expect_one_line_with(refusal_by("taylor_steel.prm", {"Scene/Symmetry planes=x, axis"}),
                       {"'axis' stands alone"});
  expect_one_line_with(refusal_by("slab_127.prm", {"Scene/Symmetry planes=axis", "slab/Layout=lattice"}),
                       {"slab/Layout", "polar"});
}

TEST(SceneInputs, InconsistentKeysAreRefused) {
  expect_one_line_with(refusal_by("slab_127.prm", {"projectile/Length=80 mm"}),
                       {"slab_127.prm", "projectile/Length"});
  expect_one_line_with(refusal_by("taylor_steel.prm", {"bar/Layers=1"}), {"taylor_steel.prm", "bar/Layers"});
  expect_one_line_with(refusal_by("taylor_steel.prm", {"bar/Rings=0"}), {"taylor_steel.prm", "bar/Rings"});
  expect_one_line_with(refusal_by("slab_127.prm", {"Contact/Order=slab, plate"}), {"Contact/Order", "plate"});
  expect_one_line_with(refusal_by("slab_127.prm", {"slab/Bonded to=projectile"}),
                       {"slab/Bonded to", "'projectile'"});
}

TEST(SceneInputs, FrictionThatFallsNeedsItsVelocityAndASchemeThatKnowsIt) {
  expect_one_line_with(refusal_by("slab_127.prm", {"Contact/Sliding friction=0.05"}),
                       {"slab_127.prm", "Contact/Friction decay velocity", "Sliding friction is set"});
  expect_one_line_with(refusal_by("slab_127.prm", {"Contact/Sliding friction=0.05", "Contact/Scheme=kernel",
                                                   "Contact/Friction decay velocity=50 m/s"}),
                       {"Contact/Sliding friction", "0.05", "kernel"});
  EXPECT_NO_THROW(
      shipped("slab_127.prm", {"Contact/Sliding friction=0.05", "Contact/Friction decay velocity=50 m/s",
                               "Contact/Largest friction stress=20 MPa"}));
}

TEST(SceneInputs, AGradedSpacingExcludesContradictingKeys) {
  const auto with = [](std::vector<std::string> more) {
    for (const char* graded : {"slab/Rings=0", "slab/Layers=0", "slab/Fine spacing=8 mm",
                               "slab/Fine radius=60 mm", "slab/Coarse spacing=16 mm"})
      more.insert(more.begin(), graded);
    return more;
  };
  const auto refusal = [&](const std::vector<std::string>& more) {
    return refusal_by("slab_127.prm", with(more));
  };
  EXPECT_NO_THROW(shipped("slab_127.prm", with({})));
  expect_one_line_with(refusal({"slab/Rings=43"}),
                       {"slab/Fine spacing", "0.008 m", "Rings and Layers (43, 0)"});
  expect_one_line_with(refusal({"slab/Layout=lattice"}), {"slab/Layout", "0.008 m", "polar"});
  expect_one_line_with(refusal({"slab/Coarse spacing=7 mm"}), {"slab/Coarse spacing", "0.007 m", "0.008 m"});
  expect_one_line_with(refusal({"slab/Coarse spacing=64 mm"}), {"slab/Coarse spacing", "0.0635 m"});
  expect_one_line_with(
      refusal_by("slab_127.prm", {"slab/Rings=0", "slab/Layers=0", "slab/Fine spacing=8 mm"}),
      {"slab/Fine radius"});
}

TEST(SceneInputs, KeysAreRequiredOnlyWhereTheyAreUsed) {
  expect_one_line_with(refusal_of(with_slab(ball), {"ball/Shape=projectile"}), {"scene.prm", "ball/Length"});
  const std::string concrete =
      with_slab("subsection slab2\n  set Shape = cylinder\n  set Behind = slab\n  set Diameter = 0.2 m\n"
                "  set Height = 50 mm\n  set Rings = 4\n  set Layers = 2\n"
                "  subsection Material\n    set Law = J2\n  end\nend\n");
  expect_one_line_with(refusal_of(concrete), {"scene.prm", "slab2/J2/"});
}

} // namespace
} // namespace spall::test
