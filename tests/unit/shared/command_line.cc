#include "shared/command_line.h"

#include "shared/error.h"
#include "tests/unit/shared/scratch_folder.h"

namespace spall::test {
namespace {

constexpr Options all = {.restart = true, .force = true, .plan = true, .accuracy = true};

CommandLine parse(std::vector<std::string> words, const Options& options = all) {
  std::string program = "program";
  std::vector<char*> argv = {program.data()};
  for (std::string& word : words) argv.push_back(word.data());
  return parse_command_line(static_cast<int>(argv.size()), argv.data(), options);
}

TEST(CommandLine, SortsTheWords) {
  const CommandLine line = parse({"a.prm", "A/B=1", "--output", "out/x", "C/D=e f", "more.csv"});
  EXPECT_EQ(line.input, "a.prm");
  EXPECT_EQ(line.overrides, (std::vector<std::string>{"A/B=1", "C/D=e f"}));
  EXPECT_EQ(line.output, "out/x");
  EXPECT_EQ(line.more, (std::vector<std::string>{"more.csv"}));
  EXPECT_FALSE(line.help);
  EXPECT_FALSE(line.restart);
  EXPECT_FALSE(line.plan);
  EXPECT_EQ(parse({"a.prm", "--output=out/x"}).output, "out/x");
  EXPECT_EQ(parse({"a.prm", "-o", "out/x"}).output, "out/x");
  EXPECT_EQ(parse({"-oout/x", "a.prm"}).output, "out/x");
  EXPECT_TRUE(parse({"--version"}).version);
  EXPECT_TRUE(parse({"--help"}).help);
  EXPECT_EQ(parse({"--help"}).topic, "");
  EXPECT_EQ(parse({"--help", "slab/AFC"}).topic, "slab/AFC");
  EXPECT_EQ(parse({"--help=Time/End time"}).topic, "Time/End time");
  EXPECT_EQ(parse({"a.prm", "--help"}).topic, "");
  EXPECT_TRUE(parse({"--restart", "a.prm"}).restart);
  EXPECT_TRUE(parse({"--plan", "a.prm"}).plan);
  EXPECT_TRUE(parse({"a.prm", "--check"}).check);
  EXPECT_TRUE(parse({"--force", "a.prm"}).force);
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"--accuracy", "5%"}, {"--accuracy=5%"}, {"--accuracy", "5"}})
    EXPECT_EQ(parse(words).overrides, std::vector<std::string>{"Run/Accuracy=5"});
  for (const std::vector<std::string>& words : {std::vector<std::string>{"--accuracy"},
                                                {"--accuracy="},
                                                {"--accuracy", "%"},
                                                {"--accuracy", "0"},
                                                {"--accuracy=nan"}})
    expect_one_line_with(message_of<InputError>([&] { parse(words); }), {"--accuracy"});
}

TEST(CommandLine, RefusesUnknownOptionsAndAMissingFolder) {
  expect_one_line_with(message_of<InputError>([] {
                         parse({"a.prm", "--ouput", "x"});
                       }),
                       {"--ouput", "did you mean '--output'?"});
  expect_one_line_with(message_of<InputError>([] { parse({"a.prm", "--output="}); }), {"--output"});
  expect_one_line_with(message_of<InputError>([] { parse({"a.prm", "-o"}); }), {"-o"});
  expect_one_line_with(message_of<InputError>([] { parse({"a.prm", "--output"}); }), {"--output"});
  expect_one_line_with(message_of<InputError>([] { parse({"a.prm", "--output", ""}); }), {"--output"});
  expect_one_line_with(message_of<InputError>([] {
                         parse({"a.prm", "--force", "--restart"});
                       }),
                       {"--force", "--restart"});
}

TEST(CommandLine, RefusesWhatIsGivenTwiceAndWhatContradictsItself) {
  for (const std::vector<std::string>& words : {std::vector<std::string>{"a.prm", "--output", "x", "-o", "y"},
                                                {"a.prm", "--force", "--force"},
                                                {"a.prm", "--accuracy", "5", "--accuracy", "6"}})
    expect_one_line_with(message_of<InputError>([&] { parse(words); }), {"twice"});
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"a.prm", "--plan", "--force"}, {"a.prm", "--plan", "--restart"}})
    expect_one_line_with(message_of<InputError>([&] { parse(words); }), {"--plan"});
  for (const auto& words :
       {std::vector<std::string>{"a.prm", "--check", "--force"}, {"--restart", "a.prm", "--check"}})
    expect_one_line_with(message_of<InputError>([&] { parse(words); }), {"--check"});
  for (const std::vector<std::string>& words : {std::vector<std::string>{"a.prm", "--output", "--force"},
                                                {"a.prm", "--force=yes"},
                                                {"a.prm", "-"},
                                                {""}})
    EXPECT_FALSE(message_of<InputError>([&] { parse(words); }).empty());
}

TEST(CommandLine, RefusesOptionsThatTheProgramDoesNotHave) {
  for (const char* option : {"--restart", "--force", "--plan", "--accuracy=5"})
    expect_one_line_with(message_of<InputError>([&] {
                           parse({"a.prm", option}, {});
                         }),
                         {"unknown option", option});
}

TEST(CommandLine, AFileMayHaveTheSignOfAnOverrideInItsName) {
  const ScratchFolder folder;
  const std::string scene = folder.write("a=b.prm", "").string();
  EXPECT_EQ(parse({scene}).input, scene);
  EXPECT_EQ(parse({"c=d.prm"}).overrides, std::vector<std::string>{"c=d.prm"});
}

TEST(CommandLine, ResultsGoIntoTheFolderGivenOrIntoOneNamedAfterTheInput) {
  EXPECT_EQ(output_folder(parse({"data/scenes/slab_127.prm"})), "out/slab_127");
  EXPECT_EQ(output_folder(parse({"data/scenes/slab_127.prm", "--output", "x"})), "x");
}

} // namespace
} // namespace spall::test
