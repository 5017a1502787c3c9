#include "shared/input/words.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace spall {
namespace {

using Words = std::vector<std::string>;

TEST(Words, PartsAreTrimmedAndEmptyOnesLeftOut) {
  EXPECT_EQ(trimmed(" \ta b\r"), "a b");
  EXPECT_EQ(trimmed(" \t"), "");
  EXPECT_EQ(split(" a b ,, c,"), (Words{"a b", "c"}));
  EXPECT_EQ(split("slab / AFC/C1", '/'), (Words{"slab", "AFC", "C1"}));
  EXPECT_EQ(split(""), Words{});
  EXPECT_EQ(joined({"slab", "AFC"}), "slab/AFC");
}

TEST(Words, CellsKeepTheirPlacesAndQuotesHoldSeparators) {
  EXPECT_EQ(cells_of("a, b ,,c", ','), (Words{"a", "b", "", "c"}));
  EXPECT_EQ(cells_of("a;", ';'), (Words{"a", ""}));
  EXPECT_EQ(cells_of("\"a,b\" ,\" c \",\"say \"\"d\"\"\"", ','), (Words{"a,b", "c", "say \"d\""}));
  EXPECT_EQ(cells_of("1\t2", '\t'), (Words{"1", "2"}));
  EXPECT_THROW(cells_of("\"a", ','), std::invalid_argument);
  EXPECT_THROW(cells_of("\"a\" b,c", ','), std::invalid_argument);
}

TEST(Words, ACommentBeginsAtTheStartOrAfterABlank) {
  EXPECT_EQ(without_comment("5 mm # of the slab"), "5 mm");
  EXPECT_EQ(without_comment("# nothing"), "");
  EXPECT_EQ(without_comment("  a#b.h5\t#c"), "a#b.h5");
  EXPECT_EQ(without_comment("\"a #1.h5\" # the first"), "a #1.h5");
  EXPECT_EQ(without_comment("say \"a\""), "say \"a\"");
  EXPECT_THROW(without_comment("\"a #1.h5"), std::invalid_argument);
  EXPECT_THROW(without_comment("\"a\".h5"), std::invalid_argument);
}

TEST(Words, TextsThatAreQuotedIfNeededAreReadAsTheyAre) {
  for (const char* text : {"", "a", "a#b", "a #b", "#a", " a", "a ", "\"a\"", "\" #", "a\\", "5 mm", "{a}"})
    EXPECT_EQ(without_comment(quoted_if_needed(text)), text) << quoted_if_needed(text);
  EXPECT_EQ(quoted_if_needed("a#b"), "a#b");
}

} // namespace
} // namespace spall
