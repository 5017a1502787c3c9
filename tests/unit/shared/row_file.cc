#include "shared/row_file.h"

#include "shared/error.h"
#include "tests/unit/shared/scratch_folder.h"
#include "tests/unit/shared/small_disk.h"

namespace spall::test {
namespace {

TEST(RowFile, KeepsTheRowsThatBelongToItAndAppends) {
  const ScratchFolder folder;
  folder.write("rows.csv", "a\nb\nhalf a r");
  RowFile file;
  file.open(folder / "rows.csv", 4);
  file.append("c\n");
  EXPECT_EQ(read_text(folder / "rows.csv"), "a\nb\nc\n");
  EXPECT_EQ(file.size(), 6u);
}

TEST(RowFile, ARowThatDoesNotFitIsTakenBack) {
  const ScratchFolder folder;
  RowFile file;
  file.open(folder / "rows.csv", 0);
  file.append("0123456\n");
  {
    const SmallDisk full(12);
    expect_one_line_with(message_of<OutputError>([&] { file.append("0123456\n"); }),
                         {"rows.csv", "File too large"});
  }
  EXPECT_EQ(read_text(folder / "rows.csv"), "0123456\n");
  file.append("next\n"); // there is room again
  EXPECT_EQ(read_text(folder / "rows.csv"), "0123456\nnext\n");
}

TEST(RowFile, WhatCannotBeOpenedIsSaid) {
  const ScratchFolder folder;
  RowFile file;
  expect_one_line_with(message_of<OutputError>([&] { file.open(folder / "none" / "rows.csv", 0); }),
                       {"rows.csv", "No such file"});
  EXPECT_FALSE(file.is_open());
}

} // namespace
} // namespace spall::test
