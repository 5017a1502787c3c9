// Tests that a projectile that would slip between the points of its target is refused, and that few points
// give a warning.

#include "macro/setup/check_shots.h"

#include "shared/error.h"
#include "tests/support/scenes.h"

#include <gtest/gtest.h>

namespace spall::test {
namespace {

using Words = std::vector<std::string>;

/// Returns the error message of the check, or its warnings, for the 127 mm slab with overrides.
std::string said(const Words& overrides, const std::string& scene = "slab_127.prm") {
  Words all = {"AFC/Damage table=", "slab/Diameter=0.4 m"};
  all.insert(all.end(), overrides.begin(), overrides.end());
  const auto file = shipped(scene, all);
  Simulation run = start(*file);
  const Answers answers(file->run.answers, file->scene, file->run.fragments, "scene.prm");
  try {
    check_shots(run, file->scene, answers, "scene.prm");
  } catch (const InputError& error) {
    return std::string("refused: ") + error.what();
  }
  std::string warnings;
  for (const std::string& warning : run.health.warnings) warnings += warning;
  return warnings;
}

TEST(CheckShots, AProjectileThinnerThanTheSpacingIsRefused) {
  const std::string text = said({"slab/Rings=12", "slab/Layers=8", "projectile/Diameter=7.62 mm",
                                 "projectile/Length=40 mm", "projectile/Mass=9.5 g"});
  for (const char* part : {"refused: scene.prm: ", "'slab'", "'projectile'", "3.81 mm"})
    EXPECT_NE(text.find(part), std::string::npos) << text;
}

TEST(CheckShots, AHoleThatTheProjectileDoesNotTouchIsRefused) {
  // Cells touch with their faces: the wall of a hole stands where it is, however coarse the points, if the
  // cells are cubes.
  const auto none_in_path = [](const char* hole) {
    return said({"slab/Rings=36", "slab/Layers=6", hole}).find("none of them is in its path") !=
           std::string::npos;
  };
  EXPECT_FALSE(none_in_path("slab/Hole diameter=48 mm"));
  EXPECT_TRUE(none_in_path("slab/Hole diameter=54 mm"));
}

TEST(CheckShots, FewPointsOverTheRadiusAreSaidAndEnoughAreNot) {
  for (const Words& planes : {Words{"Scene/Symmetry planes=x, y"}, Words{"Scene/Symmetry planes=axis"}}) {
    Words coarse = planes, fine = planes;
    coarse.insert(coarse.end(), {"slab/Rings=12", "slab/Layers=8"});
    fine.insert(fine.end(), {"slab/Rings=24", "slab/Layers=16"});
    EXPECT_NE(said(coarse).find("points of 'slab' over the radius of 'projectile'"), std::string::npos);
    EXPECT_EQ(said(fine), "");
  }
}

TEST(CheckShots, AnObliquePathIsFollowed) {
  // The straight path misses the rim of a small slab.
  const Words aside = {"slab/Rings=12", "slab/Layers=8", "Scene/Symmetry planes=y"};
  Words through = aside, beside = aside;
  through.push_back("projectile/Obliquity=20 deg");
  beside.push_back("projectile/Offset x=0.3 m");
  EXPECT_EQ(said(through).find("refused"), std::string::npos);
  EXPECT_NE(said(beside).find("none of them is in its path"), std::string::npos);
}

} // namespace
} // namespace spall::test
