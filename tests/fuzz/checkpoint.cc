// A state of any bytes is loaded or refused, and so is a checkpoint file. The first byte chooses.

#include "macro/restart/checkpoint.h"
#include "macro/restart/byte_archives.h"
#include "tests/fuzz/as_file.h"

namespace {

/// Every kind of part that states have.
struct Sample {
  double number = 0;
  std::string text;
  std::vector<double> values;
  std::vector<std::string> texts;
  std::vector<std::vector<float>> lists;

  void transfer(spall::Archive& archive) {
    archive("number", number);
    archive("text", text);
    archive("values", values);
    archive("texts", texts);
    archive("lists", lists);
  }
};

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  if (data[0] % 2 == 0)
    return spall::test::only_refuses([&] {
      const auto file = spall::test::as_file(data + 1, size - 1, ".h5");
      std::filesystem::rename(file, file.parent_path() / "checkpoint.h5");
      spall::Checkpoints(file.parent_path(), {}).find();
    });
  const auto* bytes = reinterpret_cast<const std::byte*>(data + 1);
  try {
    spall::ByteReader reader({bytes, bytes + size - 1});
    Sample sample;
    sample.transfer(reader);
    reader.finish();
  } catch (const std::runtime_error&) { // it refuses
  }
  return 0;
}
