#include "shared/input/number_rows.h"

#include "shared/error.h"
#include "tests/unit/shared/scratch_folder.h"

namespace spall::test {
namespace {

class NumberRows : public ::testing::Test {
protected:
  std::vector<NumberRow> read(const std::string& text) const {
    return read_number_rows(folder.write("t.csv", text), {"time", "exx"});
  }
  std::string refusal(const std::string& text) const {
    return message_of<InputError>([&] { read(text); });
  }
  ScratchFolder folder;
};

TEST_F(NumberRows, WhatSpreadsheetsWriteIsTheSameTable) {
  for (const char* text :
       {"# a path\ntime,exx\n\n0,0.5\n1,-2e-3\n", "# a path\nexx,time\n\n0.5,0\n-2e-3,1",
        "# a path\r\nTime , EXX\r\n\r\n0, 0.5\r\n1,-2e-3\r\n",
        "#\n\"time\",\"Exx\"\n\n\"0\",\"0.5\"\n\"1\",\"-2e-3\"\n", "#\ntime;exx\n\n0;0.5\n1;-2e-3\n",
        "#\ntime,exx\n\n+0,+0.5\n+1e0,-2e-3\n", "\xEF\xBB\xBF#\ntime,exx\n\n0,0.5\n1,-2e-3\n"}) {
    const std::vector<NumberRow> rows = read(text);
    ASSERT_EQ(rows.size(), 2U) << text;
    EXPECT_EQ(rows[0].values, (std::vector{0, 0.5})) << text;
    EXPECT_EQ(rows[1].values, (std::vector{1, -2e-3})) << text;
    EXPECT_EQ(rows[1].line, 5) << text;
  }
  EXPECT_EQ(read("\xEF\xBB\xBFtime,exx\n1,2\n").size(), 1U);
}

TEST_F(NumberRows, RefusalsNameLineFoundAndAllowed) {
  expect_one_line_with(refusal("time,strain\n"),
                       {"t.csv:1: ", "'exx' is missing", "time,strain", "time,exx"});
  expect_one_line_with(refusal("time\texx\n"), {"t.csv:1: ", "'time' is missing", "allowed: time,exx"});
  expect_one_line_with(refusal("time,exx,exx\n"), {"t.csv:1: ", "column 'exx'", "once each"});
  expect_one_line_with(refusal("time,exx,e\n"), {"t.csv:1: ", "column 'e'", "allowed: time,exx"});
  expect_one_line_with(refusal("time,exx\n1\n"), {"t.csv:2: ", "found 1 values, allowed: 2"});
  expect_one_line_with(refusal("time,exx\n1,\n"), {"t.csv:2: ", "'exx'", "found '', allowed: a number"});
  for (const char* number : {"x", "nan", "1e999", "+-1", "+", "1 mm"})
    expect_one_line_with(refusal("time,exx\n1," + std::string(number) + "\n"),
                         {"t.csv:2: ", "'exx'", "found '" + std::string(number) + "', allowed: a number"});
  expect_one_line_with(refusal("\"time,exx\n"), {"t.csv:1: ", "quote is not closed"});
}

TEST_F(NumberRows, DecimalCommasAreRefusedAsSuch) {
  const std::string point = "decimal point, no comma";
  expect_one_line_with(refusal("time;exx\n0;0,5\n"), {"t.csv:2: ", "'exx'", "found '0,5'", point});
  expect_one_line_with(refusal("time,exx\n0,\"0,5\"\n"), {"t.csv:2: ", "'exx'", "found '0,5'", point});
  expect_one_line_with(refusal("time,exx\n0,0,5\n"), {"t.csv:2: ", "found 3 values, allowed: 2", point});
}

TEST_F(NumberRows, AFileThatIsNoneIsNamed) {
  for (const auto& [file, why] : {std::pair(folder / "none.csv", "does not exist"), {folder.path, "folder"}})
    expect_one_line_with(message_of<InputError>([&, f = file] { read_number_rows(f, {"a"}); }),
                         {file.string(), why});
}

} // namespace
} // namespace spall::test
