#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace spall {

/// The text of an input file with every `include FILE` replaced by the text of that file, read where it
/// stands: of two values of one key the later one counts. An include may stand inside a section, which then
/// holds what the file holds. Paths of includes are relative to the file that names them.
struct InputText {
  /// Consecutive lines of one file, and the sections that are open at the first of them.
  struct Part {
    std::filesystem::path file;
    int first_line = 1;
    std::vector<std::string> open;
    std::string text;
  };
  /// A line that opens a section.
  struct Opening {
    std::string path; ///< names of the sections from the outermost one on, separated by '/'
    std::filesystem::path file;
    int line = 0;
  };
  std::filesystem::path file;
  std::vector<Part> parts;
  std::vector<Opening> openings; ///< opening lines of sections, in the order of the text

  /// @throws InputError: a file that is missing or includes itself, a section that is not closed, `end`
  /// without a section.
  static InputText read(const std::filesystem::path& file);
};

} // namespace spall
