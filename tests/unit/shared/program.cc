#include "shared/program.h"

#include "shared/input/visible.h"
#include "tests/unit/shared/scratch_folder.h"

#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

namespace spall::test {
namespace {

constexpr Options all = {.restart = true, .force = true, .plan = true, .accuracy = true};

CommandLine parse(std::vector<std::string> words, const Options& options = all) {
  std::string program = "program";
  std::vector<char*> argv = {program.data()};
  for (std::string& word : words) argv.push_back(word.data());
  return parse_command_line(static_cast<int>(argv.size()), argv.data(), options);
}

TEST(RunProgram, TurnsOutcomesIntoTheExitCodes) {
  EXPECT_EQ(run_program("p", [] { return ExitCode::done; }), 0);
  EXPECT_EQ(run_program("p", [] { return ExitCode::interrupted; }), 130);
  EXPECT_EQ(run_program("p", []() -> ExitCode { throw InputError("bad"); }), 2);
  EXPECT_EQ(run_program("p", []() -> ExitCode { throw ComputationError("failed"); }), 3);
  EXPECT_EQ(run_program("p", []() -> ExitCode { throw std::bad_alloc(); }), 3);
}

TEST(RunProgram, PrintsTheMessageOnStandardErrorInOneLineWithTheProgramsName) {
  ::testing::internal::CaptureStderr();
  run_program("penetrate", []() -> ExitCode { throw InputError("a.prm:3: unknown key 'x'"); });
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "penetrate: a.prm:3: unknown key 'x'\n");
}

TEST(RunProgram, PrintsHostileMessagesInOneVisibleLine) {
  const auto said = [](const std::string& message) {
    ::testing::internal::CaptureStderr();
    run_program("p", [&]() -> ExitCode { throw InputError(message); });
    return ::testing::internal::GetCapturedStderr();
  };
  EXPECT_EQ(said("a\nb\x1b[31m\xff"), "p: a\\nb\\x1b[31m\\xff\n");
  const std::string shown = said("begin" + std::string(100000, 'x') + "end");
  EXPECT_LT(shown.size(), longest_message + 100);
  EXPECT_TRUE(shown.starts_with("p: begin") && shown.ends_with("end\n")) << shown;
}

TEST(RunProgramDeathTest, SignalsAskForAnOrderlyEnd) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    EXPECT_EXIT(std::exit(run_program("p",
                                      [signal] {
                                        if (interrupted()) return ExitCode::done;
                                        std::raise(signal);
                                        return interrupted() ? ExitCode::interrupted : ExitCode::done;
                                      })),
                ::testing::ExitedWithCode(130), "");
}

TEST(RunProgramDeathTest, ASignalEndsAtOnceWhatHasNothingToSave) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    EXPECT_EXIT(run_program("p",
                            [signal] {
                              end_at_once_if_interrupted(true);
                              std::raise(signal);
                              std::fputs("still running", stderr);
                              return ExitCode::done;
                            }),
                ::testing::ExitedWithCode(130), "^interrupted before anything");
}

// The first signal must not end the program, otherwise the second one would prove nothing; therefore the text
// printed between them is expected.
TEST(RunProgramDeathTest, ASecondSignalEndsAtOnce) {
  for (const int signal : {SIGINT, SIGTERM})
    EXPECT_EXIT(run_program("p",
                            [signal] {
                              std::raise(signal);
                              std::fputs("still running", stderr);
                              std::raise(signal);
                              std::fputs(", and still", stderr);
                              return ExitCode::done;
                            }),
                ::testing::KilledBySignal(signal), "^still running$");
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

/// Exits with the code of a program that prints a word to `file`.
[[noreturn]] void print_to(const char* file, ExitCode code) {
  if (std::freopen(file, "w", stdout) == nullptr) std::exit(99);
  std::exit(run_program("p", [code] {
    std::printf("a word\n");
    return code;
  }));
}

TEST(RunProgramDeathTest, WordsThatStandardOutputDoesNotTakeAreAFailure) {
  EXPECT_EXIT(print_to("/dev/full", ExitCode::done), ::testing::ExitedWithCode(3),
              "^p: standard output could not be written");
  EXPECT_EXIT(print_to("/dev/full", ExitCode::interrupted), ::testing::ExitedWithCode(130),
              "^p: standard output");
  EXPECT_EXIT(print_to("/dev/null", ExitCode::done), ::testing::ExitedWithCode(0), "^$");
}

TEST(RunProgramDeathTest, AReaderThatGoesAwayDoesNotEndTheComputation) {
  EXPECT_EXIT(
      {
        int ends[2];
        if (pipe(ends) != 0) std::exit(99);
        dup2(ends[1], STDOUT_FILENO);
        close(ends[0]);
        std::exit(run_program("p", [] {
          std::printf("a word\n");
          std::fputs("still there\n", stderr);
          return ExitCode::done;
        }));
      },
      ::testing::ExitedWithCode(3), "^still there\np: standard output could not be written");
}

/// Exits with 0 if, with `descriptor` closed at the start, no file gets the number of a standard stream.
[[noreturn]] void start_without(int descriptor) {
  close(descriptor);
  const bool closed = hold_standard_streams();
  const int file = open("/dev/null", O_WRONLY);
  std::exit(file > 2 && closed == (descriptor == STDOUT_FILENO) ? 0 : 1);
}

TEST(RunProgramDeathTest, NoFileTakesThePlaceOfAClosedStream) {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    EXPECT_EXIT(start_without(descriptor), ::testing::ExitedWithCode(0), "");
}

} // namespace
} // namespace spall::test
