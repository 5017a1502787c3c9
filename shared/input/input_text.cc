#include "shared/input/input_text.h"

#include "shared/error.h"
#include "shared/input/words.h"

#include <fstream>
#include <map>
#include <set>
#include <stdexcept>

namespace spall {
namespace {

namespace fs = std::filesystem;

std::string place_of(const fs::path& file, int line) { return file.string() + ":" + std::to_string(line); }

/// Reads files into one InputText, line by line.
class Reader {
public:
  explicit Reader(InputText& result_) : result(result_) {}

  void read(const fs::path& file) {
    std::ifstream stream(file);
    if (fs::is_directory(file)) throw InputError(file.string() + ": is a folder, a file is needed");
    if (!stream) throw InputError(file.string() + ": cannot be opened");
    const fs::path identity = fs::absolute(file).lexically_normal();
    if (!including.insert(identity).second) throw InputError(file.string() + ": includes itself");
    result.files.push_back(file);
    const std::size_t depth = open.size(), first = result.settings.size();
    int number = 0;
    for (std::string line; std::getline(stream, line);) {
      if (++number == 1 && line.starts_with(byte_order_mark)) line.erase(0, byte_order_mark.size());
      line = trimmed(line);
      const int begin = number;
      for (std::string more; line.ends_with('\\') && !line.starts_with('#') && std::getline(stream, more);
           ++number)
        line = line.substr(0, line.size() - 1) + trimmed(more);
      try {
        take(line, file, begin, depth, first);
      } catch (const std::invalid_argument& error) {
        throw InputError(place_of(file, begin) + ": " + error.what());
      }
    }
    if (open.size() > depth)
      throw InputError(place_of(file, result.openings[opened.back()].line) + ": subsection '" + open.back() +
                       "' is not closed with 'end'");
    including.erase(identity);
  }

private:
  /// Takes one line. @param depth sections that are open around the file @param first setting of the file
  /// @throws std::invalid_argument: the line is none of an input
  void take(const std::string& line, const fs::path& file, int number, std::size_t depth, std::size_t first) {
    const std::string bare = line.starts_with('"') ? line : without_comment(line);
    const std::size_t blank = bare.find_first_of(" \t");
    const std::string word = bare.substr(0, blank),
                      rest = blank == std::string::npos ? "" : line.substr(blank + 1);
    if (bare.empty()) return;
    if (word == "include" && !rest.empty()) {
      include(file, number, without_comment(rest), first);
    } else if (word == "subsection" && blank != std::string::npos) {
      open.push_back(joined(split(bare.substr(blank), '/')));
      if (open.back().empty()) throw std::invalid_argument("found '" + bare + "', a name is missing");
      opened.push_back(result.openings.size());
      result.openings.push_back({joined(open), file, number});
    } else if (bare == "end") {
      if (open.size() == depth) throw std::invalid_argument("'end' without an open subsection");
      open.pop_back();
      opened.pop_back();
    } else if (word == "set" && bare.find('=') != std::string::npos) {
      std::vector<std::string> names = open;
      for (const std::string& name : split(bare.substr(4, bare.find('=') - 4), '/')) names.push_back(name);
      if (names.size() == open.size()) throw std::invalid_argument("found '" + bare + "', a key is missing");
      const std::string key = names.back();
      names.pop_back();
      result.settings.push_back(
          {joined(names), key, without_comment(line.substr(line.find('=') + 1)), file, number});
    } else {
      throw std::invalid_argument("found '" + bare +
                                  "', allowed: subsection NAME, set KEY = VALUE, end, include FILE");
    }
  }

  void include(const fs::path& file, int line, const std::string& name, std::size_t first) {
    const fs::path included = file.parent_path() / name;
    if (!fs::is_regular_file(included))
      throw InputError(place_of(file, line) + ": include: '" + included.string() + "' does not exist");
    const std::size_t before = result.settings.size();
    read(included);
    warn_of_replaced(file, line, name, first, before);
  }

  /// Warns of every key that `file` has set in a setting from `first` to `before`, and the include after it
  /// to another value.
  void warn_of_replaced(const fs::path& file, int line, const std::string& name, std::size_t first,
                        std::size_t before) {
    std::map<std::string, const InputText::Setting*> own, theirs;
    for (std::size_t i = first; i < result.settings.size(); ++i) {
      const InputText::Setting& setting = result.settings[i];
      if (i >= before || setting.file == file)
        (i < before ? own : theirs)[setting.section + "/" + setting.key] = &setting;
    }
    for (const auto& [key, mine] : own)
      if (const auto found = theirs.find(key); found != theirs.end() && found->second->value != mine->value)
        result.warnings.push_back(place_of(file, line) + ": include '" + name + "' sets '" + key + "' to '" +
                                  found->second->value + "', which replaces the '" + mine->value +
                                  "' of line " + std::to_string(mine->line) +
                                  ": set it after the include to keep it");
  }

  InputText& result;
  std::vector<std::string> open;
  std::vector<std::size_t> opened; ///< opening of each open section
  std::set<fs::path> including;    ///< chain of including files from the first one to the one being read
};

} // namespace

InputText InputText::read(const fs::path& file) {
  InputText text;
  text.file = file;
  Reader(text).read(file);
  return text;
}

} // namespace spall
