// Tests that the models offered for a scene are what they say, and that the cheapest one that is accurate
// enough is taken.

#include "macro/setup/alternatives.h"

#include "macro/setup/make_simulation.h"
#include "shared/error.h"
#include "tests/unit/shared/scratch_folder.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace spall::test {
namespace {

using Words = std::vector<std::string>;

std::string scene(const std::string& name) { return SPALL_DATA "/scenes/" + name + ".prm"; }

bool around_the_axis(const Alternative& one) { return one.model.starts_with("around the axis"); }

TEST(Alternatives, AreWhatTheirKeysMake) {
  for (const auto& [name, body] :
       {std::pair("slab_127_axis", "slab"), {"depth_block", "slab"}, {"taylor_copper", "bar"}}) {
    const std::vector<Alternative> all = alternatives(scene(name), {});
    // In three dimensions no block has been measured.
    ASSERT_GE(all.size(), std::string(name) == "depth_block" ? 3u : 5u) << name;
    EXPECT_EQ(std::count_if(all.begin(), all.end(), around_the_axis), 3) << name;
    for (const Alternative& one : all) {
      const SceneFile made(scene(name), one.keys);
      EXPECT_EQ(made.scene.planes().axis, around_the_axis(one));
      EXPECT_EQ(make_points(made.scene, body).owned, one.points) << one.model;
      EXPECT_TRUE(one.error.known()) << one.model << ": " << one.error.remark;
      EXPECT_EQ(one.error.remark, "") << one.model;
      EXPECT_GT(one.seconds, 0);
    }
    for (const Alternative& one : all)
      for (const Alternative& finer : all)
        if (around_the_axis(one) == around_the_axis(finer) && finer.points > one.points) {
          EXPECT_GE(one.error.relative(), finer.error.relative()) << one.model << ", " << finer.model;
        }
    EXPECT_TRUE(std::is_sorted(all.begin(), all.end(),
                               [](const auto& a, const auto& b) { return a.seconds < b.seconds; }));
  }
}

TEST(Alternatives, HaveTheSettingsOfTheShippedScenesWithWhichErrorsWereMeasured) {
  for (const char* name : {"slab_127_axis", "taylor_aluminium"}) {
    const SceneFile shipped(scene(name), {}), made(scene(name), alternatives(scene(name), {}).front().keys);
    const SolidInputs &a = shipped.run.solid, &b = made.run.solid;
    EXPECT_EQ(a.integration.scheme, b.integration.scheme);
    EXPECT_EQ(a.integration.refresh_interval, b.integration.refresh_interval);
    EXPECT_EQ(a.integration.refresh_deformation, b.integration.refresh_deformation);
    EXPECT_EQ(a.integration.least_deformation, b.integration.least_deformation);
    EXPECT_EQ(a.approximation.support.normalized_size, b.approximation.support.normalized_size);
    EXPECT_EQ(shipped.run.time.step_factor, made.run.time.step_factor);
  }
  // Settings that a scene could lack: those of concrete, on a scene that has others.
  const Words others = {"Integration/Refresh interval=9", "Approximation/Support size=2.2",
                        "Time/Step factor=0.3"};
  Words all = others;
  const std::vector<Alternative> found = alternatives(scene("slab_127_axis"), others);
  all.insert(all.end(), found.front().keys.begin(), found.front().keys.end());
  const SceneFile shipped(scene("slab_127_axis"), {}), made(scene("slab_127_axis"), all);
  EXPECT_EQ(made.run.solid.integration.refresh_interval, shipped.run.solid.integration.refresh_interval);
  EXPECT_EQ(made.run.solid.approximation.support.normalized_size,
            shipped.run.solid.approximation.support.normalized_size);
  EXPECT_EQ(made.run.time.step_factor, shipped.run.time.step_factor);
}

TEST(Alternatives, OfAShotWhoseCratersAreAskedForHaveThreeDimensions) {
  const auto axis_of = [](const Words& overrides) {
    const std::vector<Alternative> all = alternatives(scene("slab_127"), overrides);
    return std::count_if(all.begin(), all.end(), around_the_axis);
  };
  EXPECT_EQ(axis_of({"Run/Until=answered"}), 0);
  EXPECT_EQ(axis_of({"Run/Until=settled"}), 3);
}

TEST(Alternatives, TheCheapestThatIsAccurateEnoughIsTaken) {
  const std::vector<Alternative> all = alternatives(scene("slab_127_axis"), {});
  double smallest = 1;
  for (const Alternative& one : all) {
    const double error = one.error.relative();
    smallest = std::min(smallest, error);
    const Alternative& taken = cheapest(all, error, "scene.prm");
    EXPECT_LE(taken.error.relative(), error);
    for (const Alternative& other : all)
      EXPECT_TRUE(other.seconds >= taken.seconds || other.error.relative() > error) << other.model;
  }
  const std::string text = message_of<InputError>([&] { cheapest(all, 0.99 * smallest, "scene.prm"); });
  for (const char* part : {"scene.prm: key 'Run/Accuracy': found", "allowed:", "resistance"})
    EXPECT_NE(text.find(part), std::string::npos) << text;
}

TEST(Alternatives, OfASceneThatWasNeverMeasuredAreRefused) {
  for (const char* name : {"slab_127_oblique", "mortar_layer"})
    EXPECT_NE(message_of<InputError>([&] { alternatives(scene(name), {}); }).find("Run/Accuracy"),
              std::string::npos)
        << name;
}

} // namespace
} // namespace spall::test
