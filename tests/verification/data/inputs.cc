// Tests that no input that is shipped undoes its own changes by an include after them.

#include "shared/input/input_text.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace {

TEST(ShippedInputs, IncludeFirstAndChangeThen) {
  int count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(SPALL_DATA)) {
    if (entry.path().extension() != ".prm" || entry.path().parent_path().filename() == "studies") continue;
    for (const std::string& warning : spall::InputText::read(entry.path()).warnings) ADD_FAILURE() << warning;
    ++count;
  }
  EXPECT_GT(count, 30);
}

} // namespace
