// Tests of what a run with reinforcing bars leaves behind.

#include "macro/output/frames.h"
#include "macro/output/history.h"
#include "tests/support/fields.h"
#include "tests/support/scenes.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <numbers>

namespace spall::test {
namespace {

/// A coarse quarter of the reinforced slab, whose bars break soon.
Simulation small_slab() {
  return start(
      *shipped("slab_127_reinforced.prm", {"AFC/Damage table=", "slab/Diameter=0.3 m",
                                           "slab/Fine spacing=16 mm", "slab/Coarse spacing=18 mm",
                                           "slab/Fine radius=100 mm", "Reinforcement/Rupture strain=0.001"}));
}

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(Bars, FramesShowEverySegmentWithItsState) {
  const ScratchFolder folder;
  Simulation run = small_slab();
  Frames frames(folder.path, run, describe_frames(run, "slab", {}), {}, {});
  frames.write(run);
  while (run.time < 120e-6) run.advance();
  frames.write(run);
  const Reinforcement& bars = run.bodies.reinforcements[0];
  const std::size_t segments = bars.bars().segments().size();
  const Fields file(folder.path);
  EXPECT_EQ(file.read<std::int64_t>("/slab bars/segments", 2).size(), 2 * segments);
  const auto at = [&](const char* frame, const char* name, std::size_t columns = 1) {
    return file.read<float>(std::string("/frames/") + frame + "/slab bars/" + name, columns);
  };
  const auto position = at("001", "position", 3), start = at("000", "position", 3),
             moved = at("001", "displacement", 3), ruptured = at("001", "ruptured"),
             stress = at("001", "axial_stress");
  ASSERT_EQ(position.size(), 6 * segments);
  double broken = 0;
  for (std::size_t n = 0; n < 2 * segments; ++n) {
    const BarChain::Segment& segment = bars.bars().segments()[n / 2];
    EXPECT_EQ(stress[n], static_cast<float>(segment.steel.stress));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(position[3 * n + c], start[3 * n + c] + moved[3 * n + c], 1e-7);
    broken += 0.5 * ruptured[n];
  }
  EXPECT_EQ(broken, static_cast<double>(bars.bars().ruptured()));
  EXPECT_GT(broken, 0);
  const std::string index = text_of(folder / "fields.xdmf");
  EXPECT_NE(index.find("TopologyType=\"Polyline\" NumberOfElements=\"" + std::to_string(segments) +
                       "\" NodesPerElement=\"2\""),
            std::string::npos);
}

TEST(Bars, TheHistoryHasTheirEnergiesAndWhatHasBroken) {
  const ScratchFolder folder;
  Simulation run = small_slab();
  History history(folder.path, {"projectile", "slab"});
  while (run.time < 60e-6) run.advance();
  history.write(run);
  const std::string text = text_of(folder / "history.csv");
  for (const char* name :
       {"bar_kinetic_energy", "bar_work", "bond_work", "ruptured_segments", "unbonded_nodes", "largest_slip"})
    EXPECT_NE(text.find(name), std::string::npos) << name;
  EXPECT_GT(run.energies.bar_work, 0);
  EXPECT_LT(std::abs(run.energies.error()), 1e-3);
}

TEST(Bars, ASlabWithoutThemHasNoColumnsForThem) {
  const ScratchFolder folder;
  History history(folder.path, {"projectile", "slab"});
  history.write(start(*shipped("slab_127.prm", {"slab/Rings=10", "slab/Layers=4"})));
  EXPECT_EQ(text_of(folder / "history.csv").find("bar_"), std::string::npos);
}

} // namespace
} // namespace spall::test
