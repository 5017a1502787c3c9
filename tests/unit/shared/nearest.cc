// Tests of suggestions for misspelt words.

#include "shared/nearest.h"

#include <gtest/gtest.h>

namespace spall::test {
namespace {

TEST(EditDistance, CountsTheLettersToChange) {
  EXPECT_EQ(edit_distance("", ""), 0u);
  EXPECT_EQ(edit_distance("Rings", "Rings"), 0u);
  EXPECT_EQ(edit_distance("Ringz", "Rings"), 1u);
  EXPECT_EQ(edit_distance("Ring", "Rings"), 1u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
  EXPECT_EQ(edit_distance("abc", "xyz"), edit_distance("xyz", "abc"));
}

TEST(DidYouMean, NamesTheNearestWordIfOneIsNear) {
  EXPECT_EQ(did_you_mean("--ouput", {"--help", "--output"}), " (did you mean '--output'?)");
  EXPECT_EQ(did_you_mean("xyz", {"Friction", "Rings"}), "");
  EXPECT_EQ(did_you_mean("xyz", {}), "");
}

} // namespace
} // namespace spall::test
