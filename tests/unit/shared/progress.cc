// Tests of the line that shows how far a computation has come.

#include "shared/progress.h"

#include <gtest/gtest.h>

namespace spall::test {
namespace {

TEST(Progress, ALineIsNarrowerThanTheTerminal) {
  const std::string line = " 42 %  t 0.512 ms  velocity 231.4 m/s  front at 84.2 mm  about 0:12 min left";
  EXPECT_EQ(fit_to_columns(line, 80), line);
  for (const int columns : {6, 20, 40, 79}) {
    const std::string cut = fit_to_columns(std::string(200, 'x'), columns);
    EXPECT_EQ(cut.size(), static_cast<std::size_t>(columns - 1));
    EXPECT_EQ(cut.substr(cut.size() - 3), "...");
  }
}

TEST(Progress, ALogGetsNoLineInTheFirstSeconds) {
  testing::internal::CaptureStdout();
  Progress progress;
  progress.show("soon");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

TEST(FormatDuration, IsInSecondsOrMinutes) {
  EXPECT_EQ(format_duration(12.34), "12.3 s");
  EXPECT_EQ(format_duration(245), "4:05 min");
}

} // namespace
} // namespace spall::test
