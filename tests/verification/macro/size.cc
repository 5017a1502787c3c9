// Test of the memory that penetrate needs for a million points.

#include "tests/verification/macro/program.h"

namespace spall::test {
namespace {

/// This test has the label long. Gradient operators take three quarters of the memory; the largest amount has
/// been in use after a refresh and the output at the end.
TEST(LargeBody, AMillionPointsTakeTwoKilobytesEachAndFourGibibytesInAll) {
  Program program;
  ASSERT_EQ(program.run({SPALL_DATA "/scenes/slab_127.prm", "AFC/Damage table=", "slab/Rings=195",
                         "slab/Layers=34", "Time/End time=6.6 us", "Output/History interval=1 us"}),
            0)
      << program.text("stderr");
  const auto value = [summary = program.summary()](const std::string& key) {
    return std::stod(summary.at(key));
  };
  EXPECT_GE(value("points"), 1e6);
  EXPECT_GE(value("steps"), 20);
  EXPECT_LE(value("bytes_per_point"), 2000);
  EXPECT_LE(value("peak_memory_bytes"), 4.0 * (1 << 30));
}

} // namespace
} // namespace spall::test
