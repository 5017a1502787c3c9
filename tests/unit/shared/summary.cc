#include "shared/summary.h"

#include "tests/unit/shared/scratch_folder.h"

#include <cstdio>
#include <cstdlib>
#include <limits>

namespace spall::test {
namespace {

/// Returns Python's representation of the parsed JSON object, with sorted keys.
std::string parsed(const std::filesystem::path& file) {
  const std::string command =
      "/usr/bin/python3 -c \"import json, sys; print(sorted(json.load(open(sys.argv[1])).items()))\" '" +
      file.string() + "'";
  FILE* pipe = popen(command.c_str(), "r");
  std::string text;
  for (char buffer[256]; std::fgets(buffer, sizeof buffer, pipe);) text += buffer;
  EXPECT_EQ(pclose(pipe), 0) << text;
  return text;
}

TEST(Summary, IsJsonThatHoldsWhatWasSet) {
  const ScratchFolder folder;
  Summary s;
  s.set("a_real", 0.1);
  s.set("b_small", -1.5e-300);
  s.set("c_int", -3);
  s.set("d_size", std::size_t{18446744073709551615u});
  s.set("e_bool", true);
  s.set("f_text", "quote \" backslash \\ line\nend\ttab");
  s.set("g_nan", std::numeric_limits<double>::quiet_NaN());
  s.set("h_inf", -std::numeric_limits<double>::infinity());
  s.write(folder / "s.json");
  EXPECT_EQ(parsed(folder / "s.json"),
            "[('a_real', 0.1), ('b_small', -1.5e-300), ('c_int', -3), ('d_size', 18446744073709551615), "
            "('e_bool', True), "
            "('f_text', 'quote \" backslash \\\\ line\\nend tab'), ('g_nan', None), ('h_inf', None)]\n");
}

TEST(Summary, IsJsonWhenEmptyAndKeepsTheLastValueOfAKeyInItsFirstPlace) {
  const ScratchFolder folder;
  Summary s;
  s.write(folder / "empty.json");
  EXPECT_EQ(parsed(folder / "empty.json"), "[]\n");
  s.set("b", 1);
  s.set("a", 2);
  s.set("b", "three");
  s.write(folder / "s.json");
  EXPECT_EQ(parsed(folder / "s.json"), "[('a', 2), ('b', 'three')]\n");
  EXPECT_LT(s.json().find("\"b\""), s.json().find("\"a\""));
}

TEST(Summary, RealsKeepEveryBit) {
  const ScratchFolder folder;
  Summary s;
  const double value = 0.1 + 0.2;
  s.set("x", value);
  const std::string json = s.json();
  EXPECT_EQ(std::strtod(json.c_str() + json.find(':') + 1, nullptr), value);
}

} // namespace
} // namespace spall::test
