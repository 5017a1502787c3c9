// A strain path of any bytes is read or refused.

#include "macro/material/strain_path.h"
#include "tests/fuzz/as_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return spall::test::only_refuses(
      [&] { spall::read_strain_path(spall::test::as_file(data, size, ".csv")); });
}
