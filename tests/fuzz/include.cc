// A text of any bytes that includes itself and what it likes is read or refused.

#include "shared/input/input_text.h"
#include "tests/fuzz/as_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return spall::test::only_refuses([&] { spall::InputText::read(spall::test::as_file(data, size, ".prm")); });
}
