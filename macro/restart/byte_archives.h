#pragma once

#include "shared/archive.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace spall {

// States as bytes: one part after the other, each after a mark made of its name and kind, an array also after
// its length.

/// FNV-1a (Fowler, Noll and Vo) of 8 bytes at a time: finds damaged bytes, no forgery.
std::uint64_t checksum(std::span<const std::byte> bytes);

/// Counts the bytes that a ByteWriter would make.
class ByteCounter final : public Archive {
public:
  bool loading() const override { return false; }
  void item(const char* name, void* value, std::size_t count) override;
  void array(const char* name, Sequence& values) override;

  std::size_t bytes = 0;
};

class ByteWriter final : public Archive {
public:
  bool loading() const override { return false; }
  void item(const char* name, void* value, std::size_t count) override;
  void array(const char* name, Sequence& values) override;

  std::vector<std::byte> bytes;

private:
  void put(const void* data, std::size_t count);
};

/// @throws std::runtime_error naming the part that is not what is wanted
class ByteReader final : public Archive {
public:
  explicit ByteReader(std::vector<std::byte> bytes_) : bytes(std::move(bytes_)) {}
  bool loading() const override { return true; }
  std::uint64_t left() const override { return bytes.size() - next; }
  /// Call after the last part. @throws std::runtime_error if something is left
  void finish() const;
  void item(const char* name, void* value, std::size_t count) override;
  void array(const char* name, Sequence& values) override;

private:
  /// The next bytes, which must be there.
  void get(const char* name, void* data, std::size_t count);
  void expect(const char* name, std::uint32_t mark);

  std::vector<std::byte> bytes;
  std::size_t next = 0;
};

/// Throws the error for a part of a state that is not the expected one.
[[noreturn]] void refuse_part(const std::string& name);

} // namespace spall
