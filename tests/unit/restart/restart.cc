// Tests that a simulation that has been saved and loaded continues bit for bit.

#include "macro/restart/checkpoint.h"
#include "tests/unit/shared/scratch_folder.h"
#include "tests/verification/macro/scheme_cases.h"

#include <map>
#include <set>

namespace spall::test {
namespace {

constexpr int steps = 30;

class Restart : public ::testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Runs, Restart, ::testing::ValuesIn(scheme_cases()),
                         [](const auto& instance) { return instance.param.name; });

/// Stores all bytes of a state by the names of its parts.
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

void advance(Simulation& run, int count) {
  for (int i = 0; i < count; ++i) run.advance();
}

/// Returns the names of the parts in which two states differ, except wall times and structs with padding.
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
  const Case c = GetParam();
  Simulation whole = start(c);
  advance(whole, steps);
  Checkpoints checkpoints(folder.path, {});
  checkpoints.write([&](Archive& archive) { whole.transfer(archive); });
  const std::size_t saved = whole.steps;
  advance(whole, steps);

  Simulation resumed = start(c);
  advance(resumed, 3); // loading replaces any earlier state
  ASSERT_TRUE(checkpoints.find());
  checkpoints.load([&](Archive& archive) { resumed.transfer(archive); });
  EXPECT_EQ(resumed.steps, saved);
  EXPECT_TRUE(differences(resumed, whole).contains("position"));
  advance(resumed, steps);
  EXPECT_EQ(differences(resumed, whole), std::set<std::string>{});
}

} // namespace
} // namespace spall::test
