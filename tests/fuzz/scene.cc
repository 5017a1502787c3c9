// A scene of any bytes is read or refused. It may include nothing: files of the machine are not part of the
// test.

#include "macro/setup/scene_file.h"
#include "tests/fuzz/as_file.h"

#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (std::string_view(reinterpret_cast<const char*>(data), size).find("include") != std::string_view::npos)
    return 0;
  return spall::test::only_refuses([&] {
    const spall::SceneFile file(spall::test::as_file(data, size, ".prm"), {});
    file.parameters.resolved();
  });
}
