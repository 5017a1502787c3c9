// Compares the exit velocities of slabs with those of converged finite elements
// (data/experiments/slab_verification.csv).

#include "tests/support/scenes.h"

#include <gtest/gtest.h>

namespace spall::test {
namespace {

struct Shot {
  double exit_velocity; ///< of a projectile that has left the target with its tail, m/s
  double depth;         ///< largest, of the tip, which touches the target at the start, m
};
/// Computes a shipped scene until its questions are answered.
Shot shot(const std::string& name, const std::vector<std::string>& changes) {
  const auto file = shipped(name, changes);
  Simulation run = start(*file);
  Answers answers(file->run.answers, file->scene, file->run.fragments, name);
  const auto tip = [&] { return motion_of(run.bodies, "projectile").front; };
  const double touching = tip();
  double deepest = touching;
  while (!answers.reached(run)) run.advance(), answers.follow(run), deepest = std::max(deepest, tip());
  EXPECT_LT(std::abs(run.energies.error()), 2e-3);
  return {run.bodies.rigid("projectile")->velocity[2], deepest - touching};
}
double exit_velocity(const std::string& name, const std::vector<std::string>& changes) {
  const double velocity = shot(name, changes).exit_velocity;
  std::printf("%s: exit velocity %.1f m/s\n", name.c_str(), velocity);
  return velocity;
}

// Layouts scatter by 2.8 m/s at the spacing of 11 mm, so their mean is compared: rows of cells, points on the
// surface, jittered points. Means over five layouts are 239.6, 237.3, 239.3 and 237.8 m/s at 16, 11, 8, 5.3
// mm.
TEST(ConvergedSlab, ConcreteThatNothingWeakensStopsTheProjectileAsFiniteElementsDo) {
  const std::vector<std::vector<std::string>> layouts = {{},
                                                         {"slab/Boundary points=on surface"},
                                                         {"slab/Jitter=0.2", "slab/Jitter seed=1"},
                                                         {"slab/Jitter=0.2", "slab/Jitter seed=2"}};
  double mean = 0;
  for (std::vector<std::string> changes : layouts) {
    changes.insert(changes.end(), {"slab/Rings=47", "slab/Layers=12"});
    const double velocity = exit_velocity("slab_127_u.prm", changes);
    EXPECT_NEAR(velocity, 238.3, 8);
    mean += velocity / static_cast<double>(layouts.size());
  }
  EXPECT_NEAR(mean, 238.3, 4);
  // A single layout at 8 mm.
  EXPECT_NEAR(exit_velocity("slab_127_u.prm", {}), 238.3, 4);
}

// Concrete that loses stiffness as it cracks. At 8 mm it is 245.3 m/s.
TEST(ConvergedSlab, ConcreteThatLosesStiffnessInTensionStopsTheProjectileAsFiniteElementsDo) {
  EXPECT_NEAR(exit_velocity("slab_127_u.prm", {"slab/AFC/Opening=cracks", "slab/Rings=47", "slab/Layers=12"}),
              244.6, 4);
}

// A hole of 24 mm is widened to the projectile's diameter: no point lies in front of the tip.
TEST(ConvergedSlab, AHoleIsWidenedAsByFiniteElements) {
  EXPECT_NEAR(exit_velocity("slab_127_u.prm", {"slab/Hole diameter=24 mm"}), 259.6, 4);
}

// 122 mm at 277 m/s with the spacing of 5 mm, mean over five layouts 123; at 642 m/s 354 mm with 8 mm. Finite
// elements of 5 mm have 129, 125, 119 and 123 mm with holes of 3, 2, 1 and 0.5 mm radius at 277 m/s, and 419
// and 401 mm with 2 and 1 mm at 642 m/s. Where whole cells touch (Contact/Touching part) it is 110 and 293
// mm.
TEST(ConvergedSlab, ABlockIsPenetratedAsDeepAsByFiniteElements) {
  EXPECT_NEAR(shot("depth_block_u.prm", {}).depth, 0.118, 6e-3);
  const std::vector<std::string> fast = {"slab/Fine spacing=8 mm", "slab/Diameter=1.22 m", "slab/Height=1 m",
                                         "slab/Fine radius=60 mm", "projectile/Velocity=642 m/s"};
  EXPECT_NEAR(shot("depth_block_u.prm", fast).depth, 0.390, 0.040);
}

// The finite elements themselves have 207 to 224 m/s, by their hole.
TEST(ConvergedSlab, ConcreteThatCracksStopsTheProjectileAsFiniteElementsDo) {
  EXPECT_NEAR(exit_velocity("slab_127_g3.prm", {}), 214.1, 12.5);
}

TEST(ConvergedSlab, ThreeDimensionsAgreeWithRotationalSymmetry) {
  const std::vector<std::string> coarse = {"slab/Rings=20", "slab/Layers=5", "Integration/Subcells=6"};
  auto quarter = coarse;
  quarter.push_back("Scene/Symmetry planes=x, y");
  // At 25 mm, one point over the projectile's radius, both have an error: 228 and 244 m/s. At 8 mm 238 and
  // 236.
  EXPECT_NEAR(exit_velocity("slab_127_u.prm", coarse), exit_velocity("slab_127_u.prm", quarter), 0.06 * 313);
}

} // namespace
} // namespace spall::test
