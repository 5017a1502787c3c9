#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace spall {

/// A text file that grows row by row. Every row is on its way to the disk when append() returns; one that
/// cannot be written whole is taken back, so that the file ends with a whole row whatever happens.
class RowFile {
public:
  RowFile() = default;
  ~RowFile() { close(); }
  RowFile(const RowFile&) = delete;
  RowFile& operator=(const RowFile&) = delete;

  /// Opens a file and keeps its first `size` bytes. @throws OutputError if it cannot be opened or cut
  void open(const std::filesystem::path& file, std::uint64_t size);
  bool is_open() const { return descriptor >= 0; }
  /// @throws OutputError if the text cannot be written; the file is then what it was before
  void append(const std::string& text);
  std::uint64_t size() const { return bytes; }

private:
  void close();
  std::filesystem::path path;
  int descriptor = -1;
  std::uint64_t bytes = 0;
};

} // namespace spall
