#include "macro/scene/shape_inputs.h"

#include "macro/scene/filling_inputs.h"
#include "shared/error.h"
#include "tests/unit/shape/stl.h"
#include "tests/unit/shared/scratch_folder.h"

#include <numbers>

namespace spall::test {
namespace {

/// One body whose keys come from the overrides.
struct Body {
  ShapeInputs inputs;
  FillingInputs filling;
  double mass = required, density = required; ///< mass and density that are known beside the shape
  Shape shape;

  explicit Body(std::vector<std::string> keys, bool deformable = false, bool needed = true,
                double mass_ = required, double density_ = required)
      : mass(mass_), density(density_) {
    Parameters parameters;
    inputs.declare(parameters, "body", {[needed] { return needed; }, ""});
    filling.declare(parameters, "body", {[deformable] { return deformable; }, ""});
    for (std::string& key : keys) key = "body/" + key;
    const ScratchFolder folder;
    write_stl(folder / "box.stl", triangles_of(Block{.width = 0.2, .depth = 0.3, .height = 0.4}), 1e-3);
    folder.write("cone.csv", "z,r\n0,0\n-0.2,0.1\n-0.2,0\n");
    const auto file =
        folder.write("body.prm", "subsection body\nset Profile = cone.csv\nset File = box.stl\nend\n");
    parameters.read(file, keys);
    if (!needed) return;
    inputs.complete_wall(mass, density);
    inputs.validate(file.string(), "body");
    shape = inputs.shape();
    if (deformable) filling.validate(file.string(), "body", shape);
  }
};

double volume(const std::vector<std::string>& keys) { return mass_properties(Body(keys).shape).volume; }
constexpr double pi = std::numbers::pi;

TEST(ShapeInputs, EveryShapeIsMadeFromItsKeys) {
  EXPECT_NEAR(volume({"Shape=cylinder", "Diameter=0.2 m", "Height=0.3 m", "Hole diameter=0.1 m"}),
              pi * (0.01 - 0.0025) * 0.3, 1e-15);
  EXPECT_NEAR(volume({"Shape=block", "Width=0.2 m", "Depth=0.3 m", "Height=0.4 m"}), 0.024, 1e-16);
  EXPECT_NEAR(volume({"Shape=sphere", "Diameter=0.2 m"}), 4 * pi / 3 * 1e-3, 1e-14);
  EXPECT_NEAR(volume({"Shape=profile"}), pi / 3 * 0.01 * 0.2, 1e-14);
  EXPECT_NEAR(volume({"Shape=surface", "Unit=mm"}), 0.024, 1e-12);
  EXPECT_NEAR(volume({"Shape=surface", "Unit=cm"}), 24, 1e-9);
  EXPECT_TRUE(std::holds_alternative<PlaneWall>(Body({"Shape=half space"}).shape));
  EXPECT_TRUE(std::holds_alternative<Nothing>(Body({}, false, false).inputs.shape()));
}

TEST(ShapeInputs, EveryNoseIsMadeFromItsKeys) {
  const auto nose = [](std::vector<std::string> keys) {
    keys.insert(keys.end(), {"Shape=projectile", "Diameter=0.2 m", "Length=0.5 m"});
    return volume(keys);
  };
  const double shaft = pi * 0.01;
  EXPECT_NEAR(nose({"Nose=flat"}), shaft * 0.5, 1e-13);
  EXPECT_NEAR(nose({"Nose=hemisphere"}), shaft * 0.4 + 2 * pi / 3 * 1e-3, 1e-13);
  EXPECT_NEAR(nose({"Caliber radius head=0.5"}), nose({"Nose=hemisphere"}), 1e-13);
  EXPECT_NEAR(nose({"Nose=cone", "Nose length=0.3 m"}), shaft * 0.3, 1e-13);
  EXPECT_NEAR(nose({"Nose=truncated ogive", "Caliber radius head=3", "Tip diameter=0 m"}),
              nose({"Nose=ogive", "Caliber radius head=3"}), 1e-13);
  EXPECT_NEAR(nose({"Nose=blunt", "Edge radius=0.1 m"}), nose({"Nose=hemisphere"}), 1e-13);
}

const std::vector<std::string> ogive = {"Shape=projectile", "Diameter=50.8 mm", "Length=355.6 mm",
                                        "Caliber radius head=3"};
std::vector<std::string> with(std::vector<std::string> keys, const std::vector<std::string>& more) {
  keys.insert(keys.end(), more.begin(), more.end());
  return keys;
}

TEST(ShapeInputs, TheWallOfACasingIsGivenOrFollowsFromMassAndDensity) {
  const auto walls = with(ogive, {"Nose thickness=25.4 mm", "Base thickness=12.7 mm"});
  const Body from_mass(walls, false, true, 2.34, 11248);
  EXPECT_NEAR(mass_properties(from_mass.shape).volume, 2.34 / 11248, 1e-12);
  const Body given(with(walls, {"Wall thickness=4 mm"}), false, true, 2.34, 11248);
  EXPECT_EQ(given.inputs.wall_thickness, 4e-3);
  // The thickness of the wall is sufficient.
  const Body even(with(ogive, {"Wall thickness=5 mm"}));
  const Revolution& body = std::get<Revolution>(even.shape);
  EXPECT_EQ(body.inner_radius(-0.0049), 0);
  EXPECT_GT(body.inner_radius(-0.0051), 0);
  EXPECT_EQ(body.inner_radius(-0.3507), 0);
  EXPECT_FALSE(std::get<Revolution>(Body(ogive).shape).inner);
}

std::string refusal(const std::vector<std::string>& keys, bool deformable = false, double mass = required,
                    double density = required) {
  return message_of<InputError>([&] { Body(keys, deformable, true, mass, density); });
}

TEST(ShapeInputs, KeysAreRequiredOnlyByTheShapesThatUseThem) {
  expect_one_line_with(refusal({}), {"body.prm", "body/Shape", "none", "cylinder", "half space"});
  expect_one_line_with(refusal({"Shape=cylinder", "Height=1 m"}), {"body/Diameter"});
  expect_one_line_with(refusal({"Shape=block", "Height=1 m", "Width=1 m"}), {"body/Depth"});
  expect_one_line_with(refusal({"Shape=projectile", "Diameter=1 m", "Length=9 m"}),
                       {"body/Caliber radius head"});
  expect_one_line_with(refusal({"Shape=projectile", "Diameter=1 m", "Length=9 m", "Nose=cone"}),
                       {"body/Nose length"});
  expect_one_line_with(refusal({"Shape=projectile", "Diameter=1 m", "Length=9 m", "Nose=blunt"}),
                       {"body/Edge radius"});
  expect_one_line_with(refusal({"Shape=profile", "Profile="}), {"body/Profile", "CSV"});
  expect_one_line_with(refusal({"Shape=surface", "File=", "Unit=m"}), {"body/File", "STL"});
  expect_one_line_with(refusal({"Shape=surface"}), {"body/Unit", "none", "mm"});
  expect_one_line_with(refusal({"Shape=surface", "Unit=m", "File=nowhere.stl"}), {"nowhere.stl", "opened"});
}

TEST(ShapeInputs, ImpossibleShapesAreRefused) {
  expect_one_line_with(refusal({"Shape=cylinder", "Height=1 m", "Diameter=1 m", "Hole diameter=1 m"}),
                       {"body.prm", "body/Hole diameter", "found 1 m", "less than Diameter"});
  const std::vector<std::string> shaft = {"Shape=projectile", "Diameter=50 mm", "Length=80 mm"};
  expect_one_line_with(refusal(with(shaft, {"Caliber radius head=3"})),
                       {"body/Length", "found 0.08 m", "at least the length of the nose", "0.0829"});
  expect_one_line_with(refusal(with(shaft, {"Nose=blunt", "Edge radius=26 mm"})),
                       {"body/Edge radius", "found 0.026", "at most half of Diameter", "0.025 m"});
  expect_one_line_with(
      refusal(with(shaft, {"Nose=truncated ogive", "Caliber radius head=1", "Tip diameter=50 mm"})),
      {"body/Tip diameter", "0.05 m", "less than Diameter"});
  expect_one_line_with(refusal(with(ogive, {"Nose thickness=25.4 mm"})), {"body/Wall thickness", "not set"});
  expect_one_line_with(
      refusal(with(ogive, {"Nose thickness=25.4 mm", "Base thickness=12.7 mm"}), false, 20, 11248),
      {"body/Wall thickness", "mass"});
  expect_one_line_with(refusal(with(ogive, {"Wall thickness=26 mm"})),
                       {"body/Wall thickness", "found 0.026"});
  expect_one_line_with(refusal(with(ogive, {"Wall thickness=5 mm", "Base thickness=300 mm"})),
                       {"body/Nose thickness", "breaks through"});
}

TEST(FillingInputs, EveryShapeNeedsItsOwnKeys) {
  const std::vector<std::string> block = {"Shape=block", "Width=0.2 m", "Depth=0.3 m", "Height=0.4 m"},
                                 cylinder = {"Shape=cylinder", "Diameter=0.2 m", "Height=0.3 m"};
  EXPECT_NO_THROW(Body(with(block, {"Spacing=1 cm"}), true));
  EXPECT_NO_THROW(Body(with(ogive, {"Layers=70"}), true));
  EXPECT_NO_THROW(Body(with(cylinder, {"Rings=5", "Layers=7"}), true));
  const std::vector<std::string> surface = {"Shape=surface", "Unit=mm"};
  EXPECT_NO_THROW(Body(with(surface, {"Spacing=2 cm"}), true));
  expect_one_line_with(refusal(surface, true), {"body/Spacing", "not set"});
  expect_one_line_with(refusal(with(surface, {"Spacing=2 cm", "Jitter=0.5"}), true), {"body/Jitter"});
  expect_one_line_with(refusal(with(surface, {"Spacing=2 cm", "Boundary points=on surface"}), true),
                       {"body/Boundary points", "centred"});
  expect_one_line_with(refusal(block, true), {"body/Spacing", "not set"});
  expect_one_line_with(refusal(ogive, true), {"body/Layers", "found 0"});
  expect_one_line_with(refusal(with(ogive, {"Layers=70", "Wall thickness=5 mm"}), true), {"body/Rings"});
  expect_one_line_with(refusal(with(ogive, {"Layers=70", "Layout=lattice"}), true), {"body/Layout", "polar"});
  expect_one_line_with(refusal(with(ogive, {"Layers=70", "Boundary points=on surface"}), true),
                       {"body/Boundary points", "centred"});
  expect_one_line_with(refusal(with(ogive, {"Layers=70", "Jitter=0.5"}), true), {"body/Jitter"});
  expect_one_line_with(refusal(with(cylinder, {"Layers=7"}), true), {"body/Rings"});
  expect_one_line_with(
      refusal(with(block, {"Spacing=1 cm", "Fine spacing=1 mm", "Fine radius=1 cm", "Coarse spacing=1 cm"}),
              true),
      {"body/Fine spacing", "cylinder"});
  expect_one_line_with(refusal({"Shape=half space"}, true), {"body/Shape", "deformable"});
}

} // namespace
} // namespace spall::test
