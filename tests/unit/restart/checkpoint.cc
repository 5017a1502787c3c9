// Tests of checkpoint files: damaged files are refused, and a failed write keeps the old ones.

#include "macro/restart/checkpoint.h"

#include "macro/restart/byte_archives.h"
#include "shared/error.h"
#include "shared/hdf5_file.h"
#include "tests/unit/shared/scratch_folder.h"
#include "tests/unit/shared/small_disk.h"

namespace spall::test {
namespace {

namespace fs = std::filesystem;

/// A state with every kind of part.
struct Sample {
  double number = 1.5;
  std::vector<std::array<double, 3>> points = {{1, 2, 3}, {4, 5, 6}};
  std::vector<std::string> words = {"one", "", "three"};
  std::vector<std::uint16_t> many = std::vector<std::uint16_t>(1500000, 7); // larger than a write buffer
  std::vector<int> none{};

  void transfer(Archive& archive) {
    archive("number", number);
    archive("points", points);
    archive("words", words);
    archive("many", many);
    archive("none", none);
  }
  bool operator==(const Sample&) const = default;
};

const std::string input = "subsection Body\n  set Rings = 3\nend\nsubsection Time\n  set End time = 5 us\n"
                          "  set Step factor = 0.5\nend\nsubsection Run\n  set Threads = 1\nend\n";

Provenance provenance(const std::string& text = input) {
  return {"penetrate test", "scene.prm", "now", text};
}

void save(const fs::path& folder, Sample sample, const std::string& text = input) {
  Checkpoints(folder, provenance(text)).write([&](Archive& archive) { sample.transfer(archive); });
}

Sample load(const Checkpoints& checkpoints) {
  Sample sample{.number = 0, .points = {}, .words = {"x"}, .many = {1, 2}, .none = {5}};
  checkpoints.load([&](Archive& archive) { sample.transfer(archive); });
  return sample;
}

TEST(Checkpoints, TheNewestIsLoadedAndThePreviousOneKept) {
  const ScratchFolder folder;
  Checkpoints checkpoints(folder.path, provenance());
  EXPECT_FALSE(checkpoints.find());
  for (const double number : {1.0, 2.0, 3.0}) save(folder.path, {.number = number});
  ASSERT_TRUE(checkpoints.find());
  EXPECT_EQ(load(checkpoints), Sample{.number = 3.0});
  fs::remove(folder / "checkpoint.h5");
  ASSERT_TRUE(checkpoints.find());
  EXPECT_EQ(load(checkpoints), Sample{.number = 2.0});
  fs::remove(folder / "checkpoint_previous.h5");
  EXPECT_FALSE(checkpoints.find());
  EXPECT_TRUE(fs::is_empty(folder.path));
}

TEST(Checkpoints, DamagedFilesAreRefusedAndThePreviousOneUsed) {
  const ScratchFolder folder;
  for (const double number : {1.0, 2.0}) save(folder.path, {.number = number});
  const fs::path newest = folder / "checkpoint.h5";
  const std::string whole = read_text(newest);
  std::string damaged = whole;
  damaged[damaged.size() / 2] ^= 1; // in the middle of the long array

  const struct {
    std::function<void()> spoil;
    std::string complaint;
  } cases[] = {
      {[&] { fs::resize_file(newest, whole.size() / 2); }, "truncated"},
      {[&] { folder.write("checkpoint.h5", ""); }, "truncated"},
      {[&] { folder.write("checkpoint.h5", damaged); }, "checksum"},
      {[&] {
         fs::remove(newest);
         Hdf5File file(newest, Hdf5File::Mode::create);
         file.set_attribute("/", "format", std::string("other"));
         file.close();
       },
       "no checkpoint"},
      {[&] {
         fs::remove(newest);
         Hdf5File file(newest, Hdf5File::Mode::create);
         file.set_attribute("/", "format", std::string("spall penetrate checkpoint"));
         file.set_attribute("/", "format_version", 0);
         file.close();
       },
       "format version 0"},
      {[&] {
         save(folder / "..", {}, "set Rings = 4\n");
         fs::rename(folder / ".." / "checkpoint.h5", newest);
       },
       "'subsection Body'"},
  };
  for (const auto& [spoil, complaint] : cases) {
    spoil();
    Checkpoints checkpoints(folder.path, provenance());
    ::testing::internal::CaptureStderr();
    ASSERT_TRUE(checkpoints.find()) << complaint;
    EXPECT_NE(::testing::internal::GetCapturedStderr().find(complaint), std::string::npos) << complaint;
    EXPECT_EQ(load(checkpoints).number, 1) << complaint;
  }
  fs::remove(folder / "checkpoint_previous.h5");
  expect_one_line_with(message_of<InputError>([&] { Checkpoints(folder.path, provenance()).find(); }),
                       {"--restart", "checkpoint.h5", "another input"});
}

TEST(Checkpoints, OfAProgramWithOtherStateAreRefused) {
  const ScratchFolder folder;
  save(folder.path, {});
  Checkpoints checkpoints(folder.path, provenance());
  ASSERT_TRUE(checkpoints.find());
  double number = 0;
  std::vector<std::array<double, 3>> points;
  const auto refused = [&](const std::function<void(Archive&)>& transfer) {
    return message_of<InputError>([&] { checkpoints.load(transfer); });
  };
  expect_one_line_with(refused([&](Archive& a) { a("number", number); }), {"checkpoint.h5", "does not fit"});
  expect_one_line_with(refused([&](Archive& a) { a("new", number); }), {"'new'"});
  expect_one_line_with(refused([&](Archive& a) { a("number", number), a("number", number); }), {"'number'"});
  expect_one_line_with(refused([&](Archive& a) { a("number", number), a("number", points); }), {"'number'"});
}

TEST(Checkpoints, BelongToTheInputButForItsOutputAndEnd) {
  const auto replaced = [](const std::string& from, const std::string& to) {
    std::string text = input;
    return text.replace(text.find(from), from.size(), to);
  };
  EXPECT_EQ(deciding_input(replaced("Threads = 1", "Threads = 2")), deciding_input(input));
  EXPECT_EQ(deciding_input(replaced("End time = 5", "End time = 9")), deciding_input(input));
  EXPECT_NE(deciding_input(replaced("Rings = 3", "Rings = 4")), deciding_input(input));
  EXPECT_NE(deciding_input(replaced("factor = 0.5", "factor = 0.4")), deciding_input(input));
}

TEST(Checkpoints, ThatCannotBeWrittenLeaveTheOldOnesAlone) {
  const ScratchFolder folder;
  save(folder.path, {.number = 1.0});
  const std::string before = read_text(folder / "checkpoint.h5");
  {
    const SmallDisk full(before.size() / 2);
    EXPECT_NE(message_of<ComputationError>([&] { save(folder.path, {.number = 2.0}); }).find("checkpoint.h5"),
              std::string::npos);
  }
  EXPECT_EQ(read_text(folder / "checkpoint.h5"), before);
  EXPECT_FALSE(fs::exists(folder / "checkpoint_previous.h5"));
}

TEST(Checkpoints, BelongToTheContentsOfTheFilesThatTheRunHasRead) {
  const ScratchFolder folder;
  const fs::path table = folder.write("table.h5", "one");
  Sample sample;
  Checkpoints(folder.path, provenance(), {table}).write([&](Archive& archive) { sample.transfer(archive); });
  EXPECT_TRUE(Checkpoints(folder.path, provenance(), {table}).find());
  folder.write("table.h5", "another");
  expect_one_line_with(
      message_of<InputError>([&] { Checkpoints(folder.path, provenance(), {table}).find(); }),
      {"--restart", "table.h5"});
}

TEST(Checkpoints, AListIsNotLongerThanTheBytesThatAreLeft) {
  ByteWriter writer;
  std::uint64_t count = std::uint64_t{1} << 40;
  writer("words", count);
  ByteReader reader(writer.bytes);
  std::vector<std::string> words;
  EXPECT_THROW(reader("words", words), std::runtime_error);
}

} // namespace
} // namespace spall::test
