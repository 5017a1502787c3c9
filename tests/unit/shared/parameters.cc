// What Parameters accepts, and what the bound variables hold then.

#include "shared/error.h"
#include "tests/unit/shared/parameter_sample.h"
#include "tests/unit/shared/scratch_folder.h"

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

TEST(Parameters, AnIncludeIsRelativeToItsFileAndOwnValuesWin) {
  const ScratchFolder folder;
  folder.write("materials/common/base.prm", "subsection Body\nset Count = 8\nset Factor = 0.125\nend\n");
  folder.write("materials/m.prm",
               "include common/base.prm\nsubsection Body\nset Length = 3 m\nset Count = 2\nend\n");
  Sample s;
  s.parameters.read(
      folder.write("scenes/s.prm", "subsection Body\nset Count = 9\nend\ninclude ../materials/m.prm\n"), {});
  EXPECT_EQ(s.count, 9);
  EXPECT_EQ(s.length, 3);
  EXPECT_EQ(s.factor, 0.125);
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

TEST(Parameters, HelpStatesEveryKeyWithUnitDefaultAndRange) {
  const Sample s;
  const std::string help = s.parameters.help();
  for (const char* word :
       {"Body/Length", "Body/Factor", "Body/Count", "Body/On", "Body/Name", "Body/Table", "Body/Sizes",
        "Body/Axes", "Body/Colour", "Extra/Mass", "of the body", "m, mm, cm, um", "> 0 and <= 10 m",
        "default: 0.5", "red | green", "yes | no", "x, y"})
    EXPECT_NE(help.find(word), std::string::npos) << word;
}

} // namespace
} // namespace spall::test
