// A cloud of fragments stands for spheres that a file lists.

#include "macro/scene/fragment_cloud.h"

#include "macro/scene/placement.h"
#include "shared/error.h"
#include "tests/support/scenes.h"

#include <gtest/gtest.h>

namespace spall::test {
namespace {

constexpr const char* header = "mass,x,y,z,vx,vy,vz\n";
constexpr const char* three = "0.02,0,0,-0.05,0,0,900\n"
                              "0.01,0.05,-0.02,-0.06,40,-10,850\n"
                              "0.005,-0.04,0.03,-0.08,-30,20,700\n";

/// The coarse whole slab with a cloud before it, whose fragments have these rows.
std::shared_ptr<SceneFile> cloud(const std::string& rows, const std::vector<std::string>& changes = {}) {
  const ScratchFolder folder;
  const std::filesystem::path table = folder.write("cloud.csv", rows);
  std::vector<std::string> words = {
      "Scene/Symmetry planes=", "slab/Diameter=0.4 m",           "slab/Rings=10",
      "slab/Layers=6",          "projectile/Model=none",         "Answers/Exit=",
      "cloud/Model=rigid",      "cloud/Mean density=7850 kg/m3", "cloud/Fragments=" + table.string()};
  words.insert(words.end(), changes.begin(), changes.end());
  return std::make_shared<SceneFile>(
      folder.write("scene.prm", "include " SPALL_DATA "/scenes/slab_127.prm\nsubsection cloud\nend\n"),
      words);
}
/// What is said of such a scene; empty: nothing.
std::string refusal(const std::string& rows, const std::vector<std::string>& changes = {}) {
  try {
    cloud(rows, changes);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}
bool says(const std::string& message, const std::vector<std::string>& words) {
  return std::all_of(words.begin(), words.end(),
                     [&](const std::string& word) { return message.find(word) != std::string::npos; });
}

TEST(FragmentCloud, EachRowIsASphereOfItsMassAtItsPlaceWithItsVelocity) {
  const auto file = cloud(header + std::string(three));
  const Simulation run = start(*file);
  ASSERT_EQ(run.bodies.rigids.size(), 3u);
  const RigidBody& second = *run.bodies.rigid("cloud_2");
  EXPECT_DOUBLE_EQ(second.mass, 0.01);
  EXPECT_LT(norm(second.centre_of_mass() - Vec3{0.05, -0.02, -0.06}), 1e-12);
  EXPECT_EQ(second.velocity, (Vec3{40, -10, 850}));
  const double radius = second.front() + 0.06;
  EXPECT_NEAR(radius * radius * radius * 4 / 3 * 3.141592653589793 * 7850, 0.01, 1e-12);
  EXPECT_EQ(run.bodies.rigid("cloud"), nullptr);
}

TEST(FragmentCloud, AFragmentIsTheBodyThatASphereIs) {
  const auto file = cloud(header + std::string("0.02,0.01,0.02,-0.05,0,0,900\n"),
                          {"projectile/Model=rigid", "projectile/Shape=sphere", "projectile/Mass=0.02 kg",
                           "projectile/Diameter=16.944 mm", "projectile/Offset x=-50 mm",
                           "projectile/Velocity=900 m/s", "Answers/Exit=cloud_1 through slab"});
  const Simulation run = start(*file);
  const RigidBody &one = *run.bodies.rigid("cloud_1"), &other = *run.bodies.rigid("projectile");
  EXPECT_EQ(one.mass, other.mass);
  EXPECT_EQ(one.velocity, other.velocity);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(one.moments[c], other.moments[c], 1e-3 * other.moments[c]);
}

TEST(FragmentCloud, WhatIsNoCloudIsRefusedWithItsPlace) {
  const std::string rows = header + std::string(three);
  EXPECT_EQ(refusal(rows), "");
  EXPECT_TRUE(says(refusal("mass,x,y,z,vx,vy\n1,0,0,0,0,0\n"), {"cloud.csv", "vz"}));
  EXPECT_TRUE(says(refusal(header + std::string("0,0,0,0,0,0,1\n")), {"cloud.csv:2", "'mass'", "found 0"}));
  EXPECT_TRUE(
      says(refusal(header + std::string("1,0,0,0,0,0,2e4\n")), {"cloud.csv:2", "'vz'", "found 20000"}));
  EXPECT_TRUE(says(refusal(header), {"cloud.csv", "0"}));
  std::string many = header;
  for (std::size_t k = 0; k <= most_fragments; ++k)
    many += "0.001,0,0," + std::to_string(-0.1 * (k + 1.)) + ",0,0,1\n";
  EXPECT_TRUE(says(refusal(many), {"501 fragments", "1 to 500"}));
  EXPECT_TRUE(says(refusal(rows, {"cloud/Velocity=3 m/s"}), {"'cloud/Fragments'", "Velocity"}));
  EXPECT_TRUE(says(refusal(rows, {"cloud/Mass=3 kg"}), {"'cloud/Mass'"}));
  EXPECT_TRUE(says(refusal(rows, {"cloud/Shape=block"}), {"'cloud/Shape'"}));
  EXPECT_TRUE(says(refusal(rows, {"Scene/Symmetry planes=y"}), {"'Scene/Symmetry planes'", "cloud"}));
  EXPECT_TRUE(says(refusal(rows + "0.02,0,0,-0.049,0,0,900\n"), {"'cloud_1'", "'cloud_4'", "overlap"}));
}

} // namespace
} // namespace spall::test
