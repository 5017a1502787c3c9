// A simulation that has been saved and loaded goes on bit for bit.

#include "macro/output/checkpoint.h"
#include "macro/scene_simulation.h"
#include "tests/unit/output/small_bar.h"
#include "tests/unit/shared/scratch_folder.h"

#include <map>
#include <set>

namespace spall::test {
namespace {

/// A scene and its numerics by name.
struct Case {
  std::string name;
  SceneInputs scene = small_bar(Boundary::centred, {"x", "y"});
  RunInputs numerics{};
  int steps = 30;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

Case bar(const std::string& name, const std::function<void(RunInputs&)>& change) {
  Case c{.name = name};
  c.numerics.time.verify_every = 20;
  c.numerics.solid.integration.refresh_interval = 7;
  change(c.numerics);
  return c;
}

Case scheme(const std::string& name, Scheme which) {
  return bar(name, [&](RunInputs& n) { n.solid.integration.scheme = which; });
}

Case on_anvil(const std::string& name, ContactScheme contact) {
  Case c = bar(name, [](RunInputs&) {});
  c.scene.contact.scheme = contact;
  c.scene.contact.friction = 0.1;
  AnvilInputs& anvil = c.scene.anvil;
  anvil.deformable = true;
  anvil.diameter = 16e-3, anvil.height = 4e-3;
  anvil.filling = {8, 4, Boundary::on_surface};
  anvil.j2 = c.scene.j2;
  return c;
}

std::vector<Case> cases() {
  return {bar("regions_left_out", [](RunInputs& n) { n.solid.integration.least_deformation = 1e-3; }),
          scheme("SNNI", Scheme::snni),
          scheme("M_SNNI", Scheme::m_snni),
          scheme("sub_points", Scheme::subpoint),
          bar("Lagrangian",
              [](RunInputs& n) { n.solid.approximation.configuration = Configuration::lagrangian; }),
          bar("corrected", [](RunInputs& n) { n.solid.integration.correction = Correction::linear; }),
          bar("damped_double", [](RunInputs& n) { n.time.gamma = 0.6, n.solid.double_precision = true; }),
          on_anvil("surface_contact", ContactScheme::surface),
          on_anvil("kernel_contact", ContactScheme::kernel)};
}

class Restart : public ::testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Runs, Restart, ::testing::ValuesIn(cases()),
                         [](const auto& instance) { return instance.param.name; });

/// Everything a state consists of, one byte after the other, by name.
class Bytes final : public Archive {
public:
  bool loading() const override { return false; }
  std::map<std::string, std::string> streams;

protected:
  void item(const char* name, void* value, std::size_t count) override {
    streams[name].append(static_cast<const char*>(value), count);
  }
  void array(const char* name, Sequence& values) override {
    streams[name].append(static_cast<const char*>(values.data()), values.bytes());
  }
};

void advance(Simulation& run, int steps) {
  for (int i = 0; i < steps; ++i) run.advance();
}

/// Names of the parts in which two states differ, but for wall times and for structs with gaps between their
/// members.
std::set<std::string> differences(Simulation& a, Simulation& b) {
  Bytes first, second;
  a.transfer(first), b.transfer(second);
  std::set<std::string> names;
  for (const auto& [name, bytes] : first.streams)
    if (name != "phases" && name != "images" && bytes != second.streams[name]) names.insert(name);
  return names;
}

TEST_P(Restart, GoesOnBitForBit) {
  const ScratchFolder folder;
  Case c = GetParam();
  Simulation whole = make_simulation(c.scene, c.numerics);
  advance(whole, c.steps);
  Checkpoints checkpoints(folder.path, {});
  checkpoints.write([&](Archive& archive) { whole.transfer(archive); });
  advance(whole, c.steps);

  Simulation resumed = make_simulation(c.scene, c.numerics);
  advance(resumed, 3); // whatever it held, loading replaces it
  ASSERT_TRUE(checkpoints.find());
  checkpoints.load([&](Archive& archive) { resumed.transfer(archive); });
  EXPECT_EQ(resumed.steps, static_cast<std::size_t>(c.steps));
  EXPECT_TRUE(differences(resumed, whole).contains("position"));
  advance(resumed, c.steps);
  EXPECT_EQ(differences(resumed, whole), std::set<std::string>{});
}

} // namespace
} // namespace spall::test
