#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace spall {

/// The settings of an input file. Every `include FILE` stands for the lines of that file, read where it
/// stands: of two values of one key the later one counts. An include may stand inside a section, which then
/// holds what the file holds. Paths of includes are relative to the file that names them.
///
/// A line is `subsection NAME`, `set KEY = VALUE`, `set Section/Key = VALUE`, `end` or `include FILE`. A #
/// at its start or after a blank begins a comment; a value or file with such a # stands in double quotes. A
/// line that ends with \ goes on in the next one.
struct InputText {
  /// A line that sets a key.
  struct Setting {
    std::string section, key, value; ///< section: names from the outermost one on, separated by '/'
    std::filesystem::path file;
    int line = 0;
  };
  /// A line that opens a section.
  struct Opening {
    std::string path; ///< as Setting::section
    std::filesystem::path file;
    int line = 0;
  };
  std::filesystem::path file;
  std::vector<std::filesystem::path> files; ///< all that were read
  std::vector<Setting> settings;            ///< in the order of the text, as the openings
  std::vector<Opening> openings;
  std::vector<std::string> warnings; ///< a line for every key that an include sets anew

  /// @throws InputError: a file that is missing or includes itself, a section that is not closed, `end`
  /// without a section, a line that is none of those above.
  static InputText read(const std::filesystem::path& file);
};

} // namespace spall
