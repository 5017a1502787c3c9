#include "shared/seal.h"

#include "shared/input/text_file.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string>

namespace spall {
namespace {

constexpr std::array<char, 8> mark = {'S', 'P', 'A', 'L', 'L', 'C', 'R', 'C'};
/// Parts that a file leaves out at most: a checkpoint has one per list of pieces.
constexpr std::uint64_t most_parts = 10000;

/// The last bytes of a sealed file.
struct Tail {
  std::uint64_t parts = 0, size = 0, sum = 0;
  std::array<char, 8> mark{};
};
static_assert(sizeof(Tail) == 32);

std::uint32_t sum_of(std::uint32_t sum, const void* bytes, std::size_t count) {
  if (count == 0) return sum; // zlib takes a null pointer for the begin of a sum
  return static_cast<std::uint32_t>(crc32_z(sum, static_cast<const Bytef*>(bytes), count));
}

/// The checksum of the bytes [from, to) of a file behind those of `sum`.
std::uint32_t sum_of(std::uint32_t sum, std::istream& file, std::uint64_t from, std::uint64_t to) {
  std::vector<char> buffer(1 << 20);
  file.seekg(static_cast<std::streamoff>(from));
  while (from < to) {
    const auto count = std::min<std::uint64_t>(buffer.size(), to - from);
    if (!file.read(buffer.data(), static_cast<std::streamsize>(count)))
      throw std::runtime_error("cannot be read to its end");
    sum = sum_of(sum, buffer.data(), count);
    from += count;
  }
  return sum;
}

/// The last bytes of a file; zeros if it is too short for a seal.
Tail tail_of(std::istream& file, std::uint64_t size) {
  Tail tail;
  if (size <= sizeof tail) return tail;
  file.seekg(static_cast<std::streamoff>(size - sizeof tail));
  file.read(reinterpret_cast<char*>(&tail), sizeof tail);
  return tail;
}

/// The checksum of the contents without the parts, then of the list of these and of the sizes.
std::uint32_t sum_of(std::istream& file, const std::vector<ByteRange>& apart, const Tail& tail) {
  std::uint32_t sum = 0;
  std::uint64_t from = 0;
  for (const ByteRange& part : apart) {
    if (part.first < from || part.first > tail.size || part.count > tail.size - part.first)
      throw std::runtime_error("is damaged: its checksum does not fit it");
    sum = sum_of(sum, file, from, part.first);
    from = part.first + part.count;
  }
  sum = sum_of(sum, file, from, tail.size);
  sum = sum_of(sum, apart.data(), apart.size() * sizeof(ByteRange));
  return sum_of(sum, &tail, offsetof(Tail, sum));
}

} // namespace

void seal(const std::filesystem::path& path, const std::vector<ByteRange>& apart) {
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  Tail tail{.parts = apart.size(), .size = std::filesystem::file_size(path), .sum = 0, .mark = mark};
  tail.sum = sum_of(file, apart, tail);
  file.seekp(static_cast<std::streamoff>(tail.size));
  file.write(reinterpret_cast<const char*>(apart.data()),
             static_cast<std::streamsize>(apart.size() * sizeof(ByteRange)));
  file.write(reinterpret_cast<const char*>(&tail), sizeof tail);
  file.close();
  if (!file) throw std::runtime_error("its checksum cannot be written");
}

void check_seal(const std::filesystem::path& path) {
  if (const std::string fault = fault_of_file(path); !fault.empty()) throw std::runtime_error(fault);
  std::ifstream file(path, std::ios::binary);
  const std::uint64_t size = std::filesystem::file_size(path);
  const Tail tail = tail_of(file, size);
  if (tail.mark != mark)
    throw std::runtime_error(
        "is truncated, of an earlier version, or written by another program: it does not end "
        "with a checksum");
  const bool fits = tail.parts <= most_parts && tail.size <= size &&
                    size - tail.size == tail.parts * sizeof(ByteRange) + sizeof tail;
  std::vector<ByteRange> apart(fits ? tail.parts : 0);
  if (fits) {
    file.seekg(static_cast<std::streamoff>(tail.size));
    file.read(reinterpret_cast<char*>(apart.data()),
              static_cast<std::streamsize>(apart.size() * sizeof(ByteRange)));
  }
  if (!fits || !file || sum_of(file, apart, tail) != tail.sum)
    throw std::runtime_error("is damaged: its checksum is another one");
}

std::string checksums_of(const std::vector<std::filesystem::path>& files) {
  std::string text;
  for (const std::filesystem::path& path : files) {
    char sum[12] = "none";
    if (fault_of_file(path).empty()) { // a file of a body that is left out need not be there
      std::ifstream file(path, std::ios::binary);
      std::uint64_t size = std::filesystem::file_size(path);
      // A CRC of contents and of their CRC is the same for all contents.
      if (tail_of(file, size).mark == mark) size -= sizeof(Tail);
      std::snprintf(sum, sizeof sum, "%08x", sum_of(0, file, 0, size));
    }
    text += path.string() + " (checksum " + sum + ")\n";
  }
  return text;
}

} // namespace spall
