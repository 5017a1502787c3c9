#include "shared/result_folder.h"

#include "shared/error.h"
#include "tests/unit/shared/scratch_folder.h"

#include <sys/wait.h>

#include <csignal>

namespace spall::test {
namespace {

namespace fs = std::filesystem;
const std::vector<std::string> names = {"summary.json", "*fragments.csv", "fields", "fields/*.h5"};

/// Everything below a folder, with contents.
std::vector<std::pair<std::string, std::string>> contents(const fs::path& folder) {
  std::vector<std::pair<std::string, std::string>> all;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    all.emplace_back(entry.path().string(), entry.is_regular_file() ? read_text(entry.path()) : "");
  std::sort(all.begin(), all.end());
  return all;
}

/// The message of a refusal, which changes nothing.
std::string refusal(const fs::path& scratch, const fs::path& folder, Existing existing,
                    const std::vector<fs::path>& inputs = {}) {
  const auto before = contents(scratch);
  ResultFolder results(folder, names, existing);
  const std::string message = message_of<InputError>([&] { results.check(inputs); });
  EXPECT_EQ(contents(scratch), before);
  return message;
}

TEST(ResultFolder, HoldsResultsThatAreNotReplacedUnasked) {
  const ScratchFolder scratch;
  for (const char* name : {"summary.json", "ball_fragments.csv", "fields/000.h5"}) {
    const fs::path folder = scratch / (std::string("out_") + std::to_string(std::string(name).size()));
    scratch.write(folder.filename().string() + "/" + name, "old");
    expect_one_line_with(refusal(scratch.path, folder, Existing::refuse),
                         {folder.string(), std::string(name).substr(0, 6), "--force", "--output"});
  }
  scratch.write("mine/notes.txt", "no result");
  ResultFolder(scratch / "mine", names, Existing::refuse).check({});
}

TEST(ResultFolder, WhatCannotBeOneIsRefused) {
  const ScratchFolder scratch;
  scratch.write("file", "text");
  expect_one_line_with(refusal(scratch.path, scratch / "file", Existing::replace), {"is a file"});
  expect_one_line_with(refusal(scratch.path, scratch / "none", Existing::go_on),
                       {"--restart", "does not exist"});
}

TEST(ResultFolder, ForcedItReplacesResultsAndNothingElse) {
  const ScratchFolder scratch;
  for (const char* name : {"summary.json", "a_fragments.csv", "notes.txt", "fields/mine", "fields/007.h5",
                           ".spall-0123456789abcdef.part"})
    scratch.write(std::string("out/") + name, "old");
  ResultFolder folder(scratch / "out", names, Existing::replace);
  folder.check({});
  EXPECT_TRUE(fs::exists(scratch / "out" / "summary.json")); // until nothing else can be wrong
  folder.own();
  EXPECT_FALSE(fs::exists(scratch / "out" / "summary.json"));
  EXPECT_FALSE(fs::exists(scratch / "out" / "a_fragments.csv"));
  EXPECT_FALSE(fs::exists(scratch / "out" / "fields" / "007.h5"));
  EXPECT_FALSE(fs::exists(scratch / "out" / ".spall-0123456789abcdef.part")); // a killed run has left it
  EXPECT_EQ(read_text(scratch / "out" / "notes.txt"), "old");
  EXPECT_EQ(read_text(scratch / "out" / "fields" / "mine"), "old");
}

TEST(ResultFolder, AnInputAmongTheResultsIsNotReplaced) {
  const ScratchFolder scratch;
  const fs::path input = scratch.write("out/summary.json", "input");
  fs::create_symlink(scratch / "out", scratch / "link");
  for (const fs::path& name : {input, scratch / "link" / "summary.json"})
    expect_one_line_with(refusal(scratch.path, scratch / "out", Existing::replace, {name}),
                         {name.string(), "--force"});
  ResultFolder(scratch / "out", names, Existing::replace).check({scratch.write("out/scene.prm", "")});
}

TEST(ResultFolder, ResultsThatAreLinksAreNotFollowed) {
  const ScratchFolder scratch;
  scratch.write("out/a.txt", "");
  for (const char* target : {"/dev/null", "nowhere"}) {
    fs::create_symlink(target, scratch / "out" / "summary.json");
    for (const Existing existing : {Existing::replace, Existing::go_on})
      expect_one_line_with(refusal(scratch.path, scratch / "out", existing), {"summary.json", "link"});
    fs::remove(scratch / "out" / "summary.json");
  }
}

TEST(ResultFolder, AnInputUnderAnotherNameOfAResultIsNotReplaced) {
  const ScratchFolder scratch;
  scratch.write("out/summary.json", "input");
  fs::create_symlink("out/summary.json", scratch / "a.prm");
  fs::create_hard_link(scratch / "out" / "summary.json", scratch / "b.prm");
  for (const char* name : {"a.prm", "b.prm"})
    expect_one_line_with(refusal(scratch.path, scratch / "out", Existing::replace, {scratch / name}),
                         {name, "--force"});
}

TEST(ResultFolder, ThatCannotBeMadeIsRefusedBeforeAnythingIs) {
  const ScratchFolder scratch;
  scratch.write("file", "");
  for (const fs::path& folder : {scratch / "file" / "below", scratch / std::string(300, 'x')})
    expect_one_line_with(refusal(scratch.path, folder, Existing::refuse), {"output folder", "cannot be"});
}

TEST(ResultFolder, HasOneOwnerAtATimeAndNoneAfterItsDeath) {
  const ScratchFolder scratch;
  int ready[2];
  ASSERT_EQ(pipe(ready), 0);
  const pid_t owner = fork();
  if (owner == 0) {
    ResultFolder folder(scratch / "out", names, Existing::refuse);
    folder.own();
    if (write(ready[1], "x", 1) == 1) pause();
    _exit(0);
  }
  char byte;
  ASSERT_EQ(read(ready[0], &byte, 1), 1);
  for (const Existing existing : {Existing::refuse, Existing::replace, Existing::go_on})
    expect_one_line_with(refusal(scratch.path, scratch / "out", existing), {"belongs to another run"});
  kill(owner, SIGKILL);
  waitpid(owner, nullptr, 0);
  ResultFolder folder(scratch / "out", names, Existing::refuse);
  folder.check({});
  folder.own();
  EXPECT_TRUE(fs::is_empty(scratch / "out"));
}

TEST(ResultFolder, ThoseThatWriteSingleFilesShareItWithEachOtherOnly) {
  const ScratchFolder scratch;
  ResultFolder one(scratch / "out", {"a.csv"}, Existing::refuse, {}, true),
      other(scratch / "out", {"b.csv"}, Existing::refuse, {}, true);
  one.own();
  other.own();
  expect_one_line_with(refusal(scratch.path, scratch / "out", Existing::replace), {"another run"});
}

} // namespace
} // namespace spall::test
