#include "macro/restart/byte_archives.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>

namespace spall {
namespace {

constexpr std::uint64_t fnv_start = 0xcbf29ce484222325, fnv_prime = 0x100000001b3;

using Mark = std::uint32_t;

/// Returns the mark that identifies the kind of a part: array or single value, and the size of its items.
Mark mark_of(const char* name, bool is_array, std::size_t item_bytes) {
  std::uint64_t value = fnv_start;
  for (const char* letter = name; *letter != 0; ++letter)
    value = (value ^ static_cast<unsigned char>(*letter)) * fnv_prime;
  value = (value ^ (2 * item_bytes + (is_array ? 1 : 0))) * fnv_prime;
  return static_cast<Mark>(value ^ value >> 32);
}

} // namespace

std::uint64_t checksum(std::span<const std::byte> bytes) {
  std::uint64_t value = fnv_start;
  for (std::size_t i = 0; i < bytes.size(); i += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + i, std::min<std::size_t>(8, bytes.size() - i));
    value = (value ^ word) * fnv_prime;
    value ^= value >> 32; // mixes the upper bits into the lower ones, which the product does not do
  }
  return value;
}

void ByteCounter::item(const char*, void*, std::size_t count) { bytes += sizeof(Mark) + count; }
void ByteCounter::array(const char*, Sequence& values) {
  bytes += sizeof(Mark) + sizeof(std::uint64_t) + values.bytes();
}

void ByteWriter::put(const void* data, std::size_t count) {
  const auto* from = static_cast<const std::byte*>(data);
  bytes.insert(bytes.end(), from, from + count);
}
void ByteWriter::item(const char* name, void* value, std::size_t count) {
  const Mark mark = mark_of(name, false, count);
  put(&mark, sizeof mark);
  put(value, count);
}
void ByteWriter::array(const char* name, Sequence& values) {
  const Mark mark = mark_of(name, true, values.item_bytes);
  const std::uint64_t length = values.count();
  put(&mark, sizeof mark);
  put(&length, sizeof length);
  put(values.data(), values.bytes());
}

void ByteReader::get(const char* name, void* data, std::size_t count) {
  if (count > bytes.size() - next) refuse_part(name);
  if (count > 0) std::memcpy(data, bytes.data() + next, count);
  next += count;
}
void ByteReader::expect(const char* name, std::uint32_t mark) {
  Mark found = 0;
  get(name, &found, sizeof found);
  if (found != mark) refuse_part(name);
}
void ByteReader::item(const char* name, void* value, std::size_t count) {
  expect(name, mark_of(name, false, count));
  get(name, value, count);
}
void ByteReader::array(const char* name, Sequence& values) {
  expect(name, mark_of(name, true, values.item_bytes));
  std::uint64_t length = 0;
  get(name, &length, sizeof length);
  if (length > (bytes.size() - next) / values.item_bytes) refuse_part(name);
  values.resize(length);
  get(name, values.data(), values.bytes());
}
void ByteReader::finish() const {
  if (next != bytes.size()) refuse_part("end");
}

void refuse_part(const std::string& name) {
  throw std::runtime_error("'" + name + "' does not fit this program and input");
}

} // namespace spall
