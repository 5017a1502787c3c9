#include "macro/setup/plan.h"

#include "tests/support/scenes.h"

#include <gtest/gtest.h>

namespace spall::test {
namespace {

/// The plan of a small slab without symmetry planes, with overrides.
std::string plan(const std::vector<std::string>& changes) {
  std::vector<std::string> words = {"Scene/Symmetry planes=", "slab/Diameter=0.3 m", "slab/Rings=8",
                                    "slab/Layers=5"};
  words.insert(words.end(), changes.begin(), changes.end());
  const auto file = shipped("slab_127.prm", words);
  return make_plan(file->scene, file->run, "scene");
}
bool offers(const std::string& text, const std::string& planes) {
  return text.find("Scene/Symmetry planes = " + planes) != std::string::npos;
}

TEST(Plan, OffersThePlanesThatAllBodiesHave) {
  const std::string normal = plan({});
  EXPECT_TRUE(offers(normal, "x, y"));
  EXPECT_TRUE(offers(normal, "axis"));
  const std::string oblique = plan({"projectile/Obliquity=20 deg"});
  EXPECT_TRUE(offers(oblique, "y has"));
  EXPECT_FALSE(offers(oblique, "x, y"));
  for (const char* breaks : {"projectile/Offset x=30 mm", "projectile/Spin=100 rad/s"}) {
    const std::string text = plan({breaks});
    EXPECT_FALSE(offers(text, "x, y")) << breaks;
    EXPECT_FALSE(offers(text, "axis")) << breaks;
  }
}

} // namespace
} // namespace spall::test
