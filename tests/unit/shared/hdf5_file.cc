#include "shared/hdf5_file.h"

#include "tests/unit/shared/scratch_folder.h"

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
  }
  {
    Hdf5File file(folder / "a.h5", Hdf5File::Mode::append);
    file.write("/whole", whole);
    file.set_attribute("/table", "unit", 0.1);
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

} // namespace
} // namespace spall::test
