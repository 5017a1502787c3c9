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
