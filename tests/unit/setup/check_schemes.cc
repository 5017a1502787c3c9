// Tests that concrete is computed with the scheme that is verified for it, unless others are asked for.

#include "macro/setup/check_schemes.h"

#include "shared/error.h"
#include "tests/support/scenes.h"

#include <gtest/gtest.h>

namespace spall::test {
namespace {

using Words = std::vector<std::string>;

/// Returns the error message of the check, or nothing.
std::string refusal(const std::string& scene, const Words& overrides) {
  const auto file = shipped(scene, overrides);
  try {
    check_schemes(file->scene, file->run, "scene.prm");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(CheckSchemes, ConcreteIsComputedWithSubPoints) {
  EXPECT_EQ(refusal("slab_127.prm", {}), "");
  for (const auto& [name, scheme] : scheme_names) {
    if (scheme == Scheme::subpoint || is_conforming(scheme)) continue;
    const std::string text = refusal("slab_127.prm", {"Integration/Scheme=" + name});
    for (const std::string& part :
         {std::string("scene.prm: key 'Integration/Scheme'"), "found '" + name + "'", std::string("'slab'"),
          std::string("allowed: SUBPOINT")})
      EXPECT_NE(text.find(part), std::string::npos) << text;
  }
}

TEST(CheckSchemes, OthersAreComputedWhereTheyAreAskedForOrNothingSoftens) {
  EXPECT_EQ(refusal("slab_127.prm", {"Integration/Scheme=NSNI", "Integration/Unverified scheme=accept"}), "");
  EXPECT_EQ(refusal("taylor_aluminium.prm", {"Integration/Scheme=NSNI"}), "");
}

} // namespace
} // namespace spall::test
