// Tests of where the bars of a scene lie, and of bars that cannot be.

#include "shared/error.h"
#include "tests/support/scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace spall::test {
namespace {

using List = std::vector<std::string>;

/// Reads the reinforced slab with overrides: 12 mm bars, 100 mm apart, cover 20 mm, both faces and
/// directions.
std::shared_ptr<SceneFile> reinforced(const List& overrides) {
  return shipped("slab_127_reinforced.prm", overrides);
}
std::vector<BarLine> lines(const List& overrides) {
  const auto file = reinforced(overrides);
  const BodyInputs& body = *file->scene.find("slab");
  return body.reinforcement.lines(body.solid_shape(), file->scene.planes(), {});
}

TEST(ReinforcementInputs, MeshesLieUnderTheCoverOfBothFaces) {
  const double radius = 0.76 - 0.02;
  std::map<double, int> levels; // number of bars by height, mm
  for (const BarLine& line : lines({"Scene/Symmetry planes=none"})) {
    ++levels[std::round(1e4 * line.from[2]) / 10];
    EXPECT_EQ(line.share, 1);
    EXPECT_EQ(line.from[2], line.to[2]);
    const bool along_x = line.from[1] == line.to[1];
    const double across = along_x ? line.from[1] : line.from[0], half = along_x ? line.to[0] : line.to[1];
    EXPECT_NEAR(std::remainder(across, 0.1), 0, 1e-12); // one of them crosses the axis
    EXPECT_NEAR(across * across + half * half, radius * radius, 1e-12);
    EXPECT_EQ(along_x ? line.from[0] : line.from[1], -half);
  }
  EXPECT_EQ(levels, (std::map<double, int>{{26, 15}, {38, 15}, {89, 15}, {101, 15}}));
}

TEST(ReinforcementInputs, AnyPartOfTheSlabHasItsPartOfTheSteel) {
  const auto volume = [](const List& overrides) {
    double sum = 0;
    for (const BarLine& line : lines(overrides)) sum += line.share * norm(line.to - line.from);
    return sum;
  };
  for (const char* offset : {"Reinforcement/Offset=0 mm", "Reinforcement/Offset=50 mm"}) {
    const double whole = volume({"Scene/Symmetry planes=none", offset});
    EXPECT_NEAR(volume({"Scene/Symmetry planes=y", offset}), whole / 2, 1e-9);
    EXPECT_NEAR(volume({"Scene/Symmetry planes=x, y", offset}), whole / 4, 1e-9);
  }
}

TEST(ReinforcementInputs, AFaceAndADirectionCanBeLeftOut) {
  const List whole = {"Scene/Symmetry planes=none", "Reinforcement/Direction=y"};
  List front = whole, back = whole;
  front.emplace_back("Reinforcement/Faces=front"), back.emplace_back("Reinforcement/Faces=back");
  for (const BarLine& line : lines(front)) {
    EXPECT_NEAR(line.from[2], 26e-3, 1e-12);
    EXPECT_EQ(line.from[0], line.to[0]);
  }
  for (const BarLine& line : lines(back)) EXPECT_NEAR(line.from[2], 101e-3, 1e-12);
  EXPECT_EQ(lines(front).size(), 15u);
  EXPECT_TRUE(lines({"Reinforcement/Faces=none"}).empty());
}

TEST(ReinforcementInputs, BarsThatCannotBeAreRefusedWithTheirKey) {
  struct Refused {
    List overrides;
    std::string key, found;
  };
  const List none = {"Scene/Symmetry planes=none"};
  for (const Refused& r : std::vector<Refused>{
           {{"Reinforcement/Cover=45 mm"}, "slab/Reinforcement/Cover", "0.045 m"},
           {{"Reinforcement/Cover=110 mm", "Reinforcement/Faces=front"},
            "slab/Reinforcement/Cover",
            "0.11 m"},
           {{"Reinforcement/Spacing=12 mm", "Reinforcement/Offset=0 mm"},
            "slab/Reinforcement/Spacing",
            "0.012 m"},
           {{"Reinforcement/Spacing=4 m"}, "slab/Reinforcement/Spacing", "no bar"},
           {{"Reinforcement/Offset=30 mm"}, "slab/Reinforcement/Offset", "0.03 m"},
           {{"Scene/Symmetry planes=none", "Reinforcement/Offset=70 mm"},
            "slab/Reinforcement/Offset",
            "0.07 m"},
           {{"Scene/Symmetry planes=axis"}, "slab/Reinforcement/Faces", "axis"},
           {{"slab/Hole diameter=20 mm"}, "slab/Reinforcement/Faces", "hole"},
           {{"Scene/Symmetry planes=none", "slab/Obliquity=1 deg"}, "slab/Reinforcement/Faces", "Obliquity"},
           {{"slab/Reinforcement/Young's modulus="}, "Young's modulus", ""},
           {{"slab/Reinforcement/Bond=glued"}, "slab/Reinforcement/Bond", "glued"}}) {
    const std::string message = message_of<InputError>([&] { reinforced(r.overrides); });
    EXPECT_NE(message.find(r.key), std::string::npos) << r.overrides.back() << ": " << message;
    EXPECT_NE(message.find(r.found), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
  EXPECT_NO_THROW(reinforced({"Scene/Symmetry planes=none", "Reinforcement/Offset=30 mm"}));
}

TEST(ReinforcementInputs, AMeshThatIsDenserThanThePointsIsRefused) {
  const auto file = reinforced({"Reinforcement/Spacing=14 mm", "Reinforcement/Offset=0 mm",
                                "slab/Fine spacing=16 mm", "slab/Coarse spacing=40 mm"});
  const std::string message = message_of<InputError>([&] { start(*file); });
  EXPECT_NE(message.find("slab/Reinforcement/Spacing"), std::string::npos) << message;
  EXPECT_NE(message.find("spacing of the points"), std::string::npos) << message;
}

TEST(ReinforcementInputs, ConstantsOfSlipAreNeededForSlipOnly) {
  const char* const block =
      "subsection wall\n  include data/materials/steel_4340.prm\n  set Shape = block\n  set Width = 1 m\n"
      "  set Depth = 1 m\n  set Height = 0.1 m\n  set Spacing = 10 mm\n  set Velocity = 1 m/s\n"
      "  subsection Reinforcement\n    include data/reinforcement/b500b.prm\n    set Faces = front\n"
      "    set Bar diameter = 10 mm\n    set Spacing = 0.1 m\n    set Cover = 20 mm\n  end\nend\n"
      "subsection Answers\n  set Momentum = wall\nend\nsubsection Time\n  set End time = 1 ms\nend\n";
  EXPECT_NO_THROW(written(block));
  const std::string message =
      message_of<InputError>([&] { written(block, {"wall/Reinforcement/Bond=slip"}); });
  EXPECT_NE(message.find("wall/Reinforcement/Concrete strength"), std::string::npos) << message;
  EXPECT_NE(message.find("Bond = slip"), std::string::npos) << message;
}

} // namespace
} // namespace spall::test
