#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>

namespace spall {

/// Bytes of the largest text that is read as an input: far beyond any scene, and safe to hold in memory.
inline constexpr std::size_t largest_text = std::size_t{256} << 20;

/// What is wrong with a file that is to be read, or "": it is not there, a folder, a pipe or a device, or
/// must not be read. Links are followed. Never waits, and never throws.
std::string fault_of_file(const std::filesystem::path& file);

/// Returns a whole text file without the mark that some editors write at its begin. It is read to its end, or
/// refused: a disk that fails in the middle does not make a shorter file of it.
/// @throws InputError: FILE: why; a NUL byte in it, or more than largest_text
std::string read_text_file(const std::filesystem::path& file);

/// The lines of a text, one after the other, without their ends.
class Lines {
public:
  explicit Lines(std::string text_) : text(std::move(text_)) {}
  /// @return false if there is no further one
  bool next(std::string& line);

private:
  std::string text;
  std::size_t place = 0;
};

} // namespace spall
