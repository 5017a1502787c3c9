// Tests of the messages of Parameters: one line with file, line, key, the value found and the allowed values.

#include "shared/error.h"
#include "tests/unit/shared/parameter_sample.h"
#include "tests/unit/shared/scratch_folder.h"

namespace spall::test {
namespace {

/// Returns the message for a file whose section Body has `line` as its third line.
std::string refusal_of(const std::string& line, const std::vector<std::string>& overrides = {}) {
  const ScratchFolder folder;
  // A file sets a key once.
  const std::string first = line.find("Length") == std::string::npos ? "  set Length = 1 m" : "";
  const auto file = folder.write("bad.prm", "subsection Body\n" + first + "\n" + line + "\nend\n");
  Sample s;
  return message_of<InputError>([&] { s.parameters.read(file, overrides); });
}

TEST(ParameterErrors, AMisspeltKeyIsNamedWithItsLineAndTheNearestKey) {
  expect_one_line_with(refusal_of("set Lenght = 1 m"),
                       {"bad.prm:3", "'Lenght'", "did you mean 'Body/Length'"});
  expect_one_line_with(refusal_of("set Colur = red"), {"bad.prm:3", "did you mean 'Body/Colour'"});
}

TEST(ParameterErrors, AnUnknownKeyFarFromAllOthersGetsNoSuggestion) {
  const std::string message = refusal_of("set Quixotic hope = 1");
  expect_one_line_with(message, {"bad.prm:3", "unknown key 'Quixotic hope'"});
  EXPECT_EQ(message.find("did you mean"), std::string::npos) << message;
}

TEST(ParameterErrors, AnUnknownSectionIsNamed) {
  expect_one_line_with(refusal_of("end\nsubsection Bodies\n"), {"bad.prm:4", "Bodies"});
}

TEST(ParameterErrors, AFileWhoseSectionsDoNotBelongWhereItIsIncludedIsNamed) {
  const ScratchFolder folder;
  folder.write("m.prm", "\nsubsection Extra\n  set Mass = 1 g\nend\n");
  Sample s;
  expect_one_line_with(message_of<InputError>([&] {
                         s.parameters.read(folder.write("s.prm", "subsection Body\n  include m.prm\nend\n"),
                                           {});
                       }),
                       {"m.prm:2: ", "unknown subsection 'Extra' inside 'Body'"});
}

TEST(ParameterErrors, AWrongOrMissingUnitNamesTheKeyAndTheUnits) {
  for (const char* line : {"set Length = 5 kg", "set Length = 5", "set Length = five mm"})
    expect_one_line_with(refusal_of(line), {"bad.prm:3", "'Length'",
                                            "found '" + std::string(line).substr(13) + "'", "m, mm, cm, um"});
  expect_one_line_with(refusal_of("set Factor = 0.5 mm"), {"bad.prm:3", "'Factor'"});
}

TEST(ParameterErrors, AValueOutOfRangeNamesTheRange) {
  expect_one_line_with(refusal_of("set Length = 0 m"), {"bad.prm:3", "'Length'", ">= 1e-09 m and <= 10 m"});
  expect_one_line_with(refusal_of("set Length = 10001 mm"),
                       {"bad.prm:3", "'Length'", ">= 1e-09 m and <= 10 m"});
  expect_one_line_with(refusal_of("set Count = 10"), {"bad.prm:3", "'Count'", ">= 1 and <= 9"});
  expect_one_line_with(refusal_of("set Sizes = 1 mm, 2 m"), {"bad.prm:3", "'Sizes'", "<= 1 m"});
}

TEST(ParameterErrors, WordsOutsideTheListAreRefusedWithTheList) {
  expect_one_line_with(refusal_of("set Colour = blue"), {"bad.prm:3", "'Colour'", "'blue'", "red | green"});
  expect_one_line_with(refusal_of("set Axes = x, z"), {"bad.prm:3", "'Axes'", "x, y"});
  expect_one_line_with(refusal_of("set On = true"), {"bad.prm:3", "'On'", "yes | no"});
  expect_one_line_with(refusal_of("set Count = 2.5"), {"bad.prm:3", "'Count'", "whole number"});
}

TEST(ParameterErrors, AMisspeltWordGetsTheNearestOneOfTheList) {
  expect_one_line_with(refusal_of("set Colour = gren"), {"'gren'", "red | green", "did you mean 'green'?"});
  expect_one_line_with(refusal_of("set Colour = RED"), {"'RED'", "did you mean 'red'?"});
  expect_one_line_with(refusal_of("set On = Yes"), {"'Yes'", "did you mean 'yes'?"});
  expect_one_line_with(refusal_of("set Axes = x, Y"), {"'x, Y'", "did you mean 'y'?"});
  expect_one_line_with(refusal_of("", {"Body/Colour=grean"}), {"command line", "did you mean 'green'?"});
  EXPECT_EQ(refusal_of("set Colour = violet").find("did you mean"), std::string::npos);
}

TEST(ParameterErrors, CommonSlipsInNumbersAreNamed) {
  for (const char* line : {"set Length = 1,5 m", "set Factor = 0,5", "set Sizes = 1,5 mm", "set Count = 1,5"})
    expect_one_line_with(refusal_of(line), {"bad.prm:3", "found '", "decimal point, no comma"});
  expect_one_line_with(refusal_of("set Length = 1 m# long"),
                       {"bad.prm:3", "'1 m# long'", "a comment begins with a blank and #"});
  for (const char* value : {"{5 m", "{1|2} m", "+-1 m", ""})
    expect_one_line_with(refusal_of("set Length = " + std::string(value)),
                         {"bad.prm:3", "'Length'", "found '" + std::string(value) + "'", "m, mm, cm, um"});
}

TEST(ParameterErrors, ALineThatIsNoneOfAnInputIsRefusedWithWhatIsAllowed) {
  for (const char* line : {"Length = 1 m", "set Length", "SET Length = 1 m", "set", "include", "subsection",
                           "End", "\"set\" Length = 1 m"})
    expect_one_line_with(refusal_of(line), {"bad.prm:3: found '" + std::string(line) + "'",
                                            "subsection NAME, set KEY = VALUE, end, include FILE"});
  expect_one_line_with(refusal_of("set = 1 m"), {"bad.prm:3", "a key is missing"});
  expect_one_line_with(refusal_of("subsection /"), {"bad.prm:3", "a name is missing"});
  expect_one_line_with(refusal_of("set Name = \"a #1"), {"bad.prm:3", "quote is not closed"});
  expect_one_line_with(refusal_of("set Name = \"a\" b"), {"bad.prm:3", "'b' after a closing double quote"});
}

TEST(ParameterErrors, AKeyWithoutItsSectionIsToldTheSection) {
  expect_one_line_with(refusal_of("", {"Length=5 m"}),
                       {"command line", "Section/Key=value", "'Length=5 m'", "did you mean 'Body/Length'?"});
  expect_one_line_with(refusal_of("", {"mas=5 g"}), {"command line", "did you mean 'Extra/Mass'?"});
  expect_one_line_with(refusal_of("", {"=5"}), {"command line", "Section/Key=value"});
  expect_one_line_with(refusal_of("", {"Body/Name=a\nb"}).substr(0, 13), {"command line"});
  const ScratchFolder folder;
  Sample s;
  s.parameters.section("Other").number("Factor", s.extra, {}, "of another kind");
  expect_one_line_with(
      message_of<InputError>([&] { s.parameters.read(folder.write("a.prm", ""), {"Factor=1"}); }),
      {"did you mean 'Body/Factor' or 'Other/Factor'?"});
}

TEST(ParameterErrors, AMissingRequiredKeyIsNamedWithWhatIsAllowed) {
  const ScratchFolder folder;
  const auto file = folder.write("bad.prm", "subsection Body\nset Count = 2\nend\n");
  Sample s;
  expect_one_line_with(message_of<InputError>([&] { s.parameters.read(file, {}); }),
                       {"bad.prm", "'Body/Length'", "must be set", "m, mm, cm, um"});
}

TEST(ParameterErrors, AChosenSectionIsRequired) {
  expect_one_line_with(refusal_of("set Colour = green"),
                       {"bad.prm", "'Extra/Mass' must be set if Colour = green, allowed: "});
}

TEST(ParameterErrors, OverridesAreCheckedLikeTheFile) {
  expect_one_line_with(refusal_of("", {"Body/Length=5 kg"}),
                       {"command line", "Body/Length=5 kg", "m, mm, cm, um"});
  expect_one_line_with(refusal_of("", {"Body/Lenght=5 m"}), {"command line", "did you mean 'Body/Length'"});
  expect_one_line_with(refusal_of("", {"Bdy/Length=5 m"}), {"command line", "Bdy"});
  expect_one_line_with(refusal_of("", {"Length=5 m"}), {"command line", "'Length=5 m'", "Section/Key=value"});
}

TEST(ParameterErrors, MissingFilesAndCircularIncludesAreNamed) {
  const ScratchFolder folder;
  const auto reading = [&](const std::filesystem::path& file) {
    Sample s;
    return message_of<InputError>([&] { s.parameters.read(file, {}); });
  };
  expect_one_line_with(reading(folder / "none.prm"), {"none.prm", "does not exist"});
  expect_one_line_with(reading(folder.write("a.prm", "\ninclude none.prm\n")),
                       {"a.prm:2", "none.prm", "does not exist"});
  folder.write("b.prm", "include c.prm\n");
  expect_one_line_with(reading(folder.write("c.prm", "include b.prm\n")), {"c.prm", "includes itself"});
}

TEST(ParameterErrors, SectionsThatAreNotClosedOrNotOpenAreNamed) {
  const ScratchFolder folder;
  const auto reading = [&](const std::string& text) {
    Sample s;
    return message_of<InputError>([&] { s.parameters.read(folder.write("a.prm", text), {}); });
  };
  expect_one_line_with(reading("\nsubsection Body\nset Length = 1 m\n"), {"a.prm:2", "'Body' is not closed"});
  expect_one_line_with(reading("subsection Body\nend\nend\n"), {"a.prm:3", "'end' without"});
  // The section must be closed in its own file, even if the including file would close it.
  folder.write("b.prm", "subsection Extra\n");
  expect_one_line_with(reading("include b.prm\nend\n"), {"b.prm:1", "'Extra' is not closed"});
}

TEST(ParameterErrors, LineNumbersAreThoseOfTheIncludedAndOfTheIncludingFile) {
  const ScratchFolder folder;
  folder.write("m.prm", "# one\n# two\nsubsection Body\nset Lenght = 1 m\nend\n");
  folder.write("good.prm", "subsection Body\nset Length = 1 m\nend\n\n\n\n\n");
  Sample first, second;
  expect_one_line_with(
      message_of<InputError>([&] { first.parameters.read(folder.write("s.prm", "include m.prm\n"), {}); }),
      {"m.prm:4"});
  expect_one_line_with(
      message_of<InputError>([&] {
        second.parameters.read(
            folder.write("s.prm", "include good.prm\nsubsection Body\nset Lenght = 1 m\nend\n"), {});
      }),
      {"s.prm:3"});
}

} // namespace
} // namespace spall::test
