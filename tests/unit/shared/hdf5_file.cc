#include "shared/hdf5_file.h"

#include "tests/unit/shared/scratch_folder.h"

#include <array>
#include <functional>
#include <stdexcept>

namespace spall::test {
namespace {

TEST(Hdf5File, ArraysAndAttributesComeBackAsTheyWere) {
  const ScratchFolder folder;
  const std::vector<double> reals = {1, -2.5, 1e-300};
  const std::vector<float> table = {1, 2, 3, 4, 5, 6};
  const std::vector<std::int64_t> whole = {1LL << 60, -1};
  {
    Hdf5File file(folder / "a.h5", Hdf5File::Mode::create);
    file.write("/deep/down/reals", reals);
    file.write("/table", table, 3);
    file.set_attribute("/", "count", 3);
    file.set_attribute("/deep", "text", std::string("line\nline, \"quoted\""));
    file.close();
  }
  {
    Hdf5File file(folder / "a.h5", Hdf5File::Mode::append);
    file.write("/whole", whole);
    file.set_attribute("/table", "unit", 0.1);
    file.close();
  }
  const Hdf5File file(folder / "a.h5", Hdf5File::Mode::read);
  EXPECT_EQ(file.read<double>("/deep/down/reals"), reals);
  EXPECT_EQ(file.read<float>("/table", 3), table);
  EXPECT_EQ(file.read<std::int64_t>("/whole"), whole);
  EXPECT_EQ(file.integer_attribute("/", "count"), 3);
  EXPECT_EQ(file.real_attribute("/table", "unit"), 0.1);
  EXPECT_EQ(file.text_attribute("/deep", "text"), "line\nline, \"quoted\"");
  EXPECT_EQ(file.list("/"), (std::vector<std::string>{"deep", "table", "whole"}));
  EXPECT_TRUE(file.exists("/deep/down/reals"));
  EXPECT_FALSE(file.exists("/deep/up/reals"));
}

TEST(Hdf5File, EveryFailureNamesTheFileAndTheObject) {
  const ScratchFolder folder;
  Hdf5File file(folder / "a.h5", Hdf5File::Mode::create);
  file.write("/x", std::vector<double>{1, 2, 3, 4}, 2);
  file.set_attribute("/", "number", 1.0);
  const auto failing = [](const auto& action) { return message_of<std::runtime_error>(action); };
  expect_one_line_with(failing([&] { file.read<double>("/y"); }), {"a.h5", "/y", "missing"});
  expect_one_line_with(failing([&] { file.read<double>("/x"); }), {"a.h5", "/x", "dimensions"});
  expect_one_line_with(failing([&] { file.read<double>("/x", 3); }), {"a.h5", "/x", "columns"});
  expect_one_line_with(failing([&] { file.write("/x", std::vector<double>{1}); }), {"a.h5", "/x"});
  expect_one_line_with(failing([&] { file.real_attribute("/", "none"); }), {"a.h5", "none", "missing"});
  expect_one_line_with(failing([&] { file.integer_attribute("/", "number"); }), {"a.h5", "number", "type"});
  expect_one_line_with(failing([&] { file.text_attribute("/", "number"); }), {"a.h5", "number"});
  expect_one_line_with(failing([&] { Hdf5File(folder / "no" / "b.h5", Hdf5File::Mode::create); }),
                       {"b.h5", "created"});
  expect_one_line_with(failing([&] { Hdf5File(folder / "c.h5", Hdf5File::Mode::read); }),
                       {"c.h5", "not exist"});
}

/// A sealed file with an array, bytes, and what `more` puts into it.
std::filesystem::path sealed_file(const ScratchFolder& folder,
                                  const std::function<void(Hdf5File&)>& more = {}) {
  Hdf5File file(folder / "a.h5", Hdf5File::Mode::create);
  file.write("/x", std::vector<double>{1, 2, 3});
  const std::vector<std::uint8_t> bytes = {4, 5, 6, 7};
  file.allocate_bytes("/bytes", bytes.size());
  file.write_bytes("/bytes", 0, bytes.data(), bytes.size());
  if (more) more(file);
  file.close();
  return folder / "a.h5";
}

TEST(Hdf5File, ThatIsCutOrChangedIsRefusedBeforeItIsOpened) {
  const ScratchFolder folder;
  const std::string whole = read_text(sealed_file(folder));
  const auto refusal = [&](const std::string& content) {
    folder.write("b.h5", content);
    try {
      Hdf5File(folder / "b.h5", Hdf5File::Mode::read);
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  for (std::size_t size = 0; size < whole.size(); size += 97)
    expect_one_line_with(refusal(whole.substr(0, size)), {"b.h5", "checksum"});
  std::size_t unnoticed = 0; // of the array of bytes, which has checksums of its own
  for (std::size_t place = 0; place < whole.size(); ++place) {
    std::string changed = whole;
    changed[place] = static_cast<char>(changed[place] ^ 8);
    unnoticed += refusal(changed).empty();
  }
  EXPECT_EQ(unnoticed, 4u);
  EXPECT_FALSE(refusal(whole + "x").empty());
}

TEST(Hdf5File, NeverReadsBeyondAnArrayOrOutsideOfTheFile) {
  const ScratchFolder folder;
  const auto path = sealed_file(folder, [](Hdf5File& file) { file.link("/away", "other.h5", "/x"); });
  const Hdf5File file(path, Hdf5File::Mode::read);
  std::array<std::uint8_t, 8> bytes{};
  EXPECT_NO_THROW(file.read_bytes("/bytes", 1, bytes.data(), 3));
  EXPECT_EQ(bytes[2], 7);
  EXPECT_EQ(file.count("/bytes"), 4u);
  for (const auto& [first, count] :
       {std::pair(std::size_t{1}, std::size_t{4}), {5, 1}, {SIZE_MAX, 2}, {2, SIZE_MAX}})
    EXPECT_THROW(file.read_bytes("/bytes", first, bytes.data(), count), std::runtime_error);
  expect_one_line_with(message_of<std::runtime_error>([&] { file.read<double>("/away"); }),
                       {"/away", "link"});
}

} // namespace
} // namespace spall::test
