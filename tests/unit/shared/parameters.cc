// Tests of the inputs that Parameters accepts, and of the values of the bound variables.

#include "shared/error.h"
#include "tests/unit/shared/parameter_sample.h"
#include "tests/unit/shared/scratch_folder.h"

#include <algorithm>
#include <cmath>

namespace spall::test {
namespace {

TEST(Parameters, EveryKindOfKeyReachesItsVariable) {
  const ScratchFolder folder;
  Sample s;
  s.parameters.read(
      folder.write("a.prm", "# comment\nsubsection Body\n  set Length = 12 mm # trailing\n"
                            "  set Factor=0.25\n  set Count = 7\n  set On = yes\n  set Name = two words\n"
                            "  set Sizes = 1 mm, 2 cm\n  set Axes = x, y\n  set Colour = green\nend\n"
                            "subsection Extra\n  set Mass = 3 g\nend\n"),
      {});
  EXPECT_DOUBLE_EQ(s.length, 0.012);
  EXPECT_DOUBLE_EQ(s.factor, 0.25);
  EXPECT_EQ(s.count, 7);
  EXPECT_TRUE(s.on);
  EXPECT_EQ(s.name, "two words");
  EXPECT_EQ(s.sizes, (std::vector<double>{1e-3, 2e-2}));
  EXPECT_EQ(s.axes, (std::vector<std::string>{"x", "y"}));
  EXPECT_EQ(s.colour, Colour::green);
  EXPECT_DOUBLE_EQ(s.extra, 3e-3);
}

TEST(Parameters, UnsetKeysKeepTheirDefaults) {
  const ScratchFolder folder;
  Sample s;
  s.parameters.read(folder.write("a.prm", "subsection Body\nset Length = 1 m\nend\n"), {});
  EXPECT_EQ(s.factor, 0.5);
  EXPECT_EQ(s.count, 3);
  EXPECT_FALSE(s.on);
  EXPECT_EQ(s.name, "none");
  EXPECT_EQ(s.sizes, (std::vector<double>{1e-3, 2e-3}));
  EXPECT_TRUE(s.axes.empty());
  EXPECT_EQ(s.colour, Colour::red);
}

TEST(Parameters, AConditionalSectionIsNotRequiredUnlessChosen) {
  const ScratchFolder folder;
  Sample s;
  s.parameters.read(folder.write("a.prm", "subsection Body\nset Length = 1 m\nset Colour = red\nend\n"), {});
  EXPECT_TRUE(std::isnan(s.extra));
}

TEST(Parameters, OverridesWinOverTheFileAndTheLastOneWins) {
  const ScratchFolder folder;
  Sample s;
  s.parameters.read(folder.write("a.prm", "subsection Body\nset Length = 1 m\nset Count = 2\nend\n"),
                    {"Body/Length=2 cm", "Body/Count=4", "Body/Count=5", "Body/Name=a = b / c"});
  EXPECT_DOUBLE_EQ(s.length, 0.02);
  EXPECT_EQ(s.count, 5);
  EXPECT_EQ(s.name, "a = b / c");
}

TEST(Parameters, AnIncludeIsRelativeToItsFileAndStandsWhereItIsRead) {
  const ScratchFolder folder;
  folder.write("materials/common/base.prm", "subsection Body\nset Count = 8\nset Factor = 0.125\nend\n");
  folder.write("materials/m.prm",
               "include common/base.prm\nsubsection Body\nset Length = 3 m\nset Count = 2\nend\n");
  const std::string own = "subsection Body\nset Count = 9\nend\n",
                    include = "include ../materials/m.prm # a comment\n";
  Sample after, before;
  after.parameters.read(folder.write("scenes/a.prm", include + own), {});
  before.parameters.read(folder.write("scenes/b.prm", own + include), {});
  EXPECT_EQ(after.count, 9);
  EXPECT_EQ(before.count, 2);
  EXPECT_EQ(after.length, 3);
  EXPECT_EQ(after.factor, 0.125);
}

/// Two bodies, each with a material in a section of its own.
struct Nested {
  double slab = required, plate = required, thickness = 1;
  std::string table;
  Parameters parameters;
  Nested() {
    parameters.section("slab").quantity("Thickness", thickness, Dimension::length, {}, "of the slab");
    parameters.section("slab/AFC").number("C1", slab, {}, "of the slab's material");
    parameters.section("slab/AFC").file("Table", table, "of the slab's material");
    parameters.section("plate/AFC").number("C1", plate, {}, "of the plate's material");
  }
};

TEST(Parameters, SectionsMayBeNestedAndAFileIncludedInsideOne) {
  const ScratchFolder folder;
  folder.write("materials/m.prm", "subsection AFC\n  set C1 = 5\n  set Table = t.h5\nend\n");
  Nested s;
  s.parameters.read(folder.write("s.prm",
                                 "subsection slab\n  include materials/m.prm\n  set Thickness = 3 m\nend\n"
                                 "subsection plate\n  subsection AFC\n    set C1 = 7\n  end\nend\n"),
                    {});
  EXPECT_EQ(s.slab, 5);
  EXPECT_EQ(s.plate, 7);
  EXPECT_EQ(s.thickness, 3);
  EXPECT_EQ(s.table, folder / "materials/t.h5");
  Nested again;
  again.parameters.read(folder.write("resolved.prm", s.parameters.resolved()), {});
  EXPECT_EQ(again.plate, 7);
}

TEST(Parameters, AKeyMayNameItsSectionsInAFileAsOnTheCommandLine) {
  const ScratchFolder folder;
  Nested s;
  s.parameters.read(folder.write("s.prm",
                                 "subsection slab\n  set AFC/C1 = 5 # a comment\n  set AFC/Table = a/t.h5\n"
                                 "  set Thickness = 3 m\nend\nset plate/AFC/C1 = 7\n"),
                    {});
  EXPECT_EQ(s.slab, 5);
  EXPECT_EQ(s.plate, 7);
  EXPECT_EQ(s.thickness, 3);
  EXPECT_EQ(s.table, folder / "a/t.h5");
  Nested bad;
  expect_one_line_with(message_of<InputError>([&] {
                         bad.parameters.read(folder.write("bad.prm", "\nset plate/AFC/C2 = 7\n"), {});
                       }),
                       {"bad.prm:2: ", "unknown key 'C2'"});
}

TEST(Parameters, AByteOrderMarkAndWindowsLineEndsAreRead) {
  const ScratchFolder folder;
  Nested s;
  s.parameters.read(folder.write("s.prm", "\xEF\xBB\xBFset slab/AFC/C1 = 5\r\nset plate/AFC/C1 = 7\r\n"), {});
  EXPECT_EQ(s.slab, 5);
  EXPECT_EQ(s.plate, 7);
}

TEST(Parameters, NamesMayHoldTheSignOfAComment) {
  const ScratchFolder folder;
  folder.write("m #1.prm", "set AFC/C1 = 5 # a comment\n");
  folder.write("n#2.prm", "set plate/AFC/C1 = 7\n");
  Nested s;
  s.parameters.read(folder.write("s#.prm",
                                 "subsection slab # of concrete\n  include \"m #1.prm\" # its material\n"
                                 "  set AFC/Table = a#1.h5 # a table\nend\ninclude n#2.prm\n"),
                    {});
  EXPECT_EQ(s.slab, 5);
  EXPECT_EQ(s.plate, 7);
  EXPECT_EQ(s.table, folder / "a#1.h5");
  for (const std::string name : {"b#2.h5", "b #2.h5", "#2.h5", "b\" #2.h5", "b{2}.h5", "b\\"}) {
    Nested first, again;
    first.parameters.read(folder / "s#.prm", {"slab/AFC/Table=" + name});
    EXPECT_EQ(first.table, std::filesystem::current_path() / name);
    again.parameters.read(folder.write("resolved.prm", first.parameters.resolved()), {});
    EXPECT_EQ(again.table, first.table);
  }
}

TEST(Parameters, ALineGoesOnAfterABackslash) {
  const ScratchFolder folder;
  Sample s;
  s.parameters.read(
      folder.write("a.prm", "# a comment \\\nset Body/Sizes = 1 mm, \\\n   2 mm\nset Body/Length = 1 m\n"),
      {});
  EXPECT_EQ(s.sizes, (std::vector{1e-3, 2e-3}));
  Sample bad;
  expect_one_line_with(message_of<InputError>([&] {
                         bad.parameters.read(
                             folder.write("b.prm", "set Body/Name = a \\\n b\nset Body/Nam = a\n"), {});
                       }),
                       {"b.prm:3"});
}

TEST(Parameters, NumbersMayHaveAPlusSign) {
  const ScratchFolder folder;
  Sample s;
  s.parameters.read(folder.write("a.prm", "subsection Body\nset Length = +5 mm\nset Count = +4\n"
                                          "set Sizes = +1 mm, 2 mm\nend\n"),
                    {"Body/Factor=+0.25"});
  EXPECT_DOUBLE_EQ(s.length, 5e-3);
  EXPECT_EQ(s.count, 4);
  EXPECT_EQ(s.sizes, (std::vector{1e-3, 2e-3}));
  EXPECT_EQ(s.factor, 0.25);
}

TEST(Parameters, AnIncludeThatReplacesAValueSetBeforeItIsAWarning) {
  const ScratchFolder folder;
  folder.write("m.prm", "subsection AFC\n  set C1 = 5\nend\n");
  const auto warnings = [&](const std::string& text) {
    Nested s;
    s.parameters.read(folder.write("s.prm", text + "set plate/AFC/C1 = 7\n"), {"slab/AFC/C1=6"});
    return s.parameters.warnings();
  };
  const auto found = warnings("subsection slab\n  set AFC/C1 = 4\n  include m.prm\nend\n");
  ASSERT_EQ(found.size(), 1U);
  expect_one_line_with(found[0], {"s.prm:3: include 'm.prm'", "'slab/AFC/C1'", "'5'", "'4' of line 2"});
  EXPECT_TRUE(warnings("subsection slab\n  include m.prm\n  set AFC/C1 = 4\nend\n").empty());
  EXPECT_TRUE(warnings("subsection slab\n  set AFC/C1 = 5\n  include m.prm\nend\n").empty());
  EXPECT_TRUE(warnings("subsection slab\n  set Thickness = 5 m\n  include m.prm\nend\n").empty());
  folder.write("n.prm", "set slab/AFC/C1 = 6\n");
  EXPECT_TRUE(warnings("subsection slab\n  include m.prm\nend\ninclude n.prm\n").empty());
}

TEST(Parameters, AnOverrideMayLeaveOutTheOuterSectionsWhereOnlyOneFits) {
  const ScratchFolder folder;
  const auto file = folder.write("s.prm", "");
  Nested s;
  s.parameters.read(file, {"slab/AFC/C1=2", "plate/AFC/C1=3", "AFC/Table=/a/t.h5"});
  EXPECT_EQ(s.slab, 2);
  EXPECT_EQ(s.plate, 3);
  EXPECT_EQ(s.table, "/a/t.h5");
  // If several sections fit, the one that the file opens is meant.
  Nested opened;
  opened.parameters.read(folder.write("o.prm", "subsection plate\nsubsection AFC\nset C1 = 1\nend\nend\n"),
                         {"AFC/C1=4", "slab/AFC/C1=2"});
  EXPECT_EQ(opened.plate, 4);
  Nested ambiguous;
  expect_one_line_with(message_of<InputError>([&] { ambiguous.parameters.read(file, {"AFC/C1=2"}); }),
                       {"command line", "could mean slab/AFC/C1, plate/AFC/C1"});
}

TEST(Parameters, TheTextOfAnInputKnowsWhereItsSectionsAreOpened) {
  const ScratchFolder folder;
  folder.write("m.prm", "\nsubsection AFC\nend\n");
  const InputText text = InputText::read(
      folder.write("s.prm", "subsection slab # of concrete\n  include m.prm\nend\nsubsection Run\nend\n"));
  ASSERT_EQ(text.openings.size(), 3u);
  EXPECT_EQ(text.openings[0].path, "slab");
  EXPECT_EQ(text.openings[1].path, "slab/AFC");
  EXPECT_EQ(text.openings[1].line, 2);
  EXPECT_EQ(text.openings[1].file, folder / "m.prm");
  EXPECT_EQ(text.openings[2].path, "Run");
}

TEST(Parameters, AFileMayBeIncludedByTwoFilesButNotByItself) {
  const ScratchFolder folder;
  folder.write("base.prm", "subsection Body\nset Length = 3 m\nend\n");
  folder.write("a.prm", "include base.prm\n");
  folder.write("b.prm", "include base.prm\n");
  Sample s;
  s.parameters.read(folder.write("s.prm", "include a.prm\ninclude b.prm\n"), {});
  EXPECT_EQ(s.length, 3);
  Sample circle;
  EXPECT_THROW(circle.parameters.read(folder.write("c.prm", "include c.prm\n"), {}), InputError);
}

TEST(Parameters, AFilePathIsRelativeToTheFileThatSetsIt) {
  const ScratchFolder folder;
  folder.write("materials/m.prm", "subsection Body\nset Length = 3 m\nset Table = ../tables/t.h5\nend\n");
  const auto scene = folder.write("scenes/deep/s.prm", "include ../../materials/m.prm\n");
  {
    Sample s;
    s.parameters.read(scene, {});
    EXPECT_EQ(s.table, folder / "tables/t.h5");
  }
  {
    Sample s;
    s.parameters.read(folder.write("scenes/deep/own.prm",
                                   "include ../../materials/m.prm\nsubsection Body\nset Table = u.h5\nend\n"),
                      {});
    EXPECT_EQ(s.table, folder / "scenes/deep/u.h5");
  }
  {
    Sample s;
    s.parameters.read(scene, {"Body/Table=out/t.h5"});
    EXPECT_EQ(s.table, std::filesystem::current_path() / "out/t.h5");
  }
  {
    Sample s;
    s.parameters.read(scene, {"Body/Table=/somewhere/t.h5"});
    EXPECT_EQ(s.table, "/somewhere/t.h5");
  }
  {
    Sample s;
    s.parameters.read(scene, {"Body/Table="});
    EXPECT_EQ(s.table, "");
  }
}

TEST(Parameters, TheResolvedInputGivesTheSameValuesAgain) {
  const ScratchFolder folder;
  Sample first;
  first.parameters.read(
      folder.write("a.prm", "subsection Body\nset Length = 0.3 mm\nset Colour = green\n"
                            "set Sizes = 3 mm\nset Axes = y\nend\nsubsection Extra\nset Mass = 1 g\nend\n"),
      {"Body/Count=4"});
  Sample second;
  second.parameters.read(folder.write("resolved.prm", first.parameters.resolved()), {});
  EXPECT_EQ(second.length, first.length);
  EXPECT_EQ(second.factor, first.factor);
  EXPECT_EQ(second.count, 4);
  EXPECT_EQ(second.sizes, first.sizes);
  EXPECT_EQ(second.axes, first.axes);
  EXPECT_EQ(second.colour, Colour::green);
  EXPECT_EQ(second.extra, first.extra);
}

TEST(Parameters, TheResolvedInputMeansTheSameFromAnyFolderAndLeavesOutWhatHasNoValue) {
  const ScratchFolder folder;
  Sample first;
  first.parameters.read(
      folder.write("deep/a.prm", "subsection Body\nset Length = 1 m\nset Table = ../t.h5\nend\n"), {});
  const std::string text = first.parameters.resolved();
  EXPECT_EQ(text.find("REQUIRED"), std::string::npos) << text;
  EXPECT_EQ(text.find("Extra"), std::string::npos) << text;
  Sample second;
  second.parameters.read(folder.write("elsewhere/far/resolved.prm", text), {});
  EXPECT_EQ(second.table, folder / "t.h5");
  EXPECT_EQ(second.parameters.resolved(), text);
}

TEST(Parameters, ResolvedInputsOfEarlierVersionsAreRead) {
  const ScratchFolder folder;
  Sample s;
  s.parameters.read(folder.write("a.prm", "set Body/Length = 1 m\nset Extra/Mass = REQUIRED\n"), {});
  EXPECT_TRUE(std::isnan(s.extra));
  EXPECT_EQ(s.parameters.resolved().find("REQUIRED"), std::string::npos);
  Sample lacking;
  expect_one_line_with(message_of<InputError>([&] {
                         lacking.parameters.read(folder.write("b.prm", "set Body/Length = REQUIRED\n"), {});
                       }),
                       {"'Body/Length' must be set"});
}

TEST(Parameters, KnowsTheFilesThatWereReadAndThoseThatKeysName) {
  const ScratchFolder folder;
  folder.write("b.prm", "subsection Body\nset Length = 1 m\nset Table = t.h5\nend\n");
  Sample s;
  s.parameters.read(folder.write("a.prm", "include b.prm\n"), {});
  const auto files = s.parameters.files();
  for (const char* name : {"a.prm", "b.prm", "t.h5"})
    EXPECT_NE(std::find(files.begin(), files.end(), folder / name), files.end()) << name;
  EXPECT_EQ(std::count(files.begin(), files.end(), ""), 0);
}

TEST(Parameters, HelpStatesEveryKeyWithUnitDefaultAndRange) {
  const Sample s;
  const std::string help = s.parameters.help();
  for (const char* word :
       {"Body/Length", "Body/Factor", "Body/Count", "Body/On", "Body/Name", "Body/Table", "Body/Sizes",
        "Body/Axes", "Body/Colour", "Extra/Mass", "of the body", "m, mm, cm, um", ">= 1e-09 m and <= 10 m",
        "default: 0.5", "red | green", "yes | no", "x, y"})
    EXPECT_NE(help.find(word), std::string::npos) << word;
  EXPECT_EQ(help.find("REQUIRED"), std::string::npos);
}

TEST(Parameters, HelpSaysWhenAKeyWithoutADefaultMustBeSet) {
  const auto of = [](const char* topic) { return Sample().parameters.help(topic); };
  EXPECT_NE(of("Body/Length").find("must be set; allowed"), std::string::npos);
  EXPECT_NE(of("Extra/Mass").find("must be set if Colour = green; allowed"), std::string::npos);
  const Needed a{[] { return true; }, "A = 1"}, b{[] { return false; }, "B = 2"};
  EXPECT_EQ((a && b).describe(), "must be set if A = 1 and B = 2");
  EXPECT_FALSE((a && b).now());
  EXPECT_TRUE((a && Needed{}).now());
  EXPECT_EQ((Needed{} && a).describe(), "must be set if A = 1");
  EXPECT_EQ(Needed::never().describe(), "not set by default");
}

TEST(Parameters, HelpOnASectionOrAKeyShowsOnlyThat) {
  Nested s;
  const std::string all = s.parameters.help();
  EXPECT_EQ(s.parameters.help("slab").find("plate"), std::string::npos);
  for (const char* topic : {"AFC", "afc", "C1", "AFC/C1"}) {
    const std::string text = s.parameters.help(topic);
    EXPECT_NE(text.find("slab/AFC/C1"), std::string::npos) << topic;
    EXPECT_NE(text.find("plate/AFC/C1"), std::string::npos) << topic;
    EXPECT_EQ(text.find("Thickness"), std::string::npos) << topic;
    EXPECT_LT(text.size(), all.size());
  }
  EXPECT_EQ(s.parameters.help("slab/afc/c1").find("Table"), std::string::npos);
  for (const auto& [topic, meant] :
       {std::pair("Thicknes", "'Thickness'"), {"slab/Thicknes", "'slab/Thickness'"}, {"AFCC", "'AFC'"}})
    expect_one_line_with(message_of<InputError>([&, t = topic] { s.parameters.help(t); }),
                         {std::string("found '") + topic + "'", "allowed: a section or a key",
                          std::string("did you mean ") + meant});
}

} // namespace
} // namespace spall::test
