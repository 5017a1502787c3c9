#include "shared/output_directory.h"

#include "shared/error.h"
#include "tests/unit/shared/scratch_folder.h"
#include "tests/unit/shared/small_disk.h"

#include <set>
#include <stdexcept>

namespace spall::test {
namespace {

std::size_t count_files(const std::filesystem::path& folder) {
  return std::distance(std::filesystem::directory_iterator(folder), std::filesystem::directory_iterator());
}

TEST(WriteAtomically, ReplacesTheFileAndLeavesNothingElse) {
  const ScratchFolder folder;
  write_atomically(folder / "a.txt", "old");
  write_atomically(folder / "a.txt", "new");
  EXPECT_EQ(read_text(folder / "a.txt"), "new");
  EXPECT_EQ(count_files(folder.path), 1u);
}

TEST(WriteAtomically, KeepsTheOldFileWhenTheWriterFailsHalfWay) {
  const ScratchFolder folder;
  write_atomically(folder / "a.txt", "old");
  const std::string message = message_of<ComputationError>([&] {
    write_atomically(folder / "a.txt", [](const std::filesystem::path& temporary) {
      std::ofstream(temporary) << "ha";
      throw std::runtime_error("the disk is full");
    });
  });
  expect_one_line_with(message, {"a.txt", "the disk is full"});
  EXPECT_EQ(read_text(folder / "a.txt"), "old");
  EXPECT_EQ(count_files(folder.path), 1u);
}

TEST(WriteAtomically, TheFileIsTheOldOneUntilTheWriterIsDone) {
  const ScratchFolder folder;
  write_atomically(folder / "a.txt", "old");
  write_atomically(folder / "a.txt", [&](const std::filesystem::path& temporary) {
    std::ofstream(temporary) << "new";
    EXPECT_EQ(read_text(folder / "a.txt"), "old");
  });
  EXPECT_EQ(read_text(folder / "a.txt"), "new");
}

TEST(WriteAtomically, FailsWhereNothingCanBeWritten) {
  const ScratchFolder folder;
  EXPECT_THROW(write_atomically(folder / "none" / "a.txt", "text"), ComputationError);
}

TEST(WriteAtomically, ReplacesALinkAndFollowsNone) {
  const ScratchFolder folder;
  folder.write("victim", "old");
  for (const char* name : {"a.txt", "a.txt.part"}) std::filesystem::create_symlink("victim", folder / name);
  write_atomically(folder / "a.txt", "text");
  EXPECT_EQ(read_text(folder / "victim"), "old");
  EXPECT_EQ(read_text(folder / "a.txt"), "text");
  EXPECT_FALSE(std::filesystem::is_symlink(folder / "a.txt"));
}

TEST(WriteAtomically, ItsTemporaryNamesAreNewAndCannotBePredicted) {
  const ScratchFolder folder;
  std::set<std::filesystem::path> names;
  for (int i = 0; i < 20; ++i)
    write_atomically(folder / "a.txt", [&](const std::filesystem::path& temporary) {
      EXPECT_TRUE(Temporary::is_one(temporary));
      EXPECT_TRUE(std::filesystem::is_empty(temporary));
      EXPECT_TRUE(names.insert(temporary).second);
    });
}

TEST(WriteAtomically, ReplacesNothingThatIsNoFile) {
  const ScratchFolder folder;
  std::filesystem::create_directories(folder / "a.txt");
  expect_one_line_with(message_of<OutputError>([&] { write_atomically(folder / "a.txt", "text"); }),
                       {"a.txt", "no regular file"});
  EXPECT_TRUE(std::filesystem::is_directory(folder / "a.txt"));
}

TEST(WriteAtomically, AFileThatDoesNotFitLeavesTheOldOne) {
  const ScratchFolder folder;
  write_atomically(folder / "a.txt", "old");
  {
    const SmallDisk full(100);
    EXPECT_THROW(write_atomically(folder / "a.txt", std::string(101, 'x')), OutputError);
  }
  EXPECT_EQ(read_text(folder / "a.txt"), "old");
  EXPECT_EQ(count_files(folder.path), 1u);
}

TEST(MakeOutputDirectory, CreatesParentsAcceptsWhatIsThereAndRefusesAFile) {
  const ScratchFolder folder;
  make_output_directory(folder / "a" / "b");
  EXPECT_TRUE(std::filesystem::is_directory(folder / "a" / "b"));
  EXPECT_NO_THROW(make_output_directory(folder / "a" / "b"));
  folder.write("file", "text");
  EXPECT_THROW(make_output_directory(folder / "file"), InputError);
  EXPECT_THROW(make_output_directory(folder / "file" / "below"), InputError);
}

} // namespace
} // namespace spall::test
