#include "shared/input/input_text.h"

#include "shared/error.h"
#include "shared/input/text_file.h"
#include "shared/input/words.h"

#include <map>
#include <set>
#include <stdexcept>

namespace spall {
namespace {

namespace fs = std::filesystem;

/// Bounds of what one input may consist of. No scene comes near them; a text that repeats itself does.
constexpr std::size_t deepest_include = 32, most_files = 1000, deepest_section = 16;

std::string place_of(const fs::path& file, int line) { return file.string() + ":" + std::to_string(line); }

/// Reads files into one InputText, line by line.
class Reader {
public:
  explicit Reader(InputText& result_) : result(result_) {}

  void read(const fs::path& file) {
    const fs::path identity = identity_of(file);
    Lines lines(read_text_file(file));
    if (including.size() >= deepest_include)
      throw InputError(file.string() + ": is included by " + std::to_string(including.size()) +
                       " files one inside the other, allowed: " + std::to_string(deepest_include - 1));
    if (!including.insert(identity).second) throw InputError(file.string() + ": includes itself");
    result.files.push_back(file);
    if (result.files.size() > most_files)
      throw InputError(file.string() + ": is included after " + std::to_string(most_files) +
                       " other files, allowed: no more than these");
    const Source source{file, open.size(), result.settings.size()};
    std::map<std::string, int> own;
    int number = 0;
    for (std::string line; lines.next(line);) {
      ++number;
      line = trimmed(line);
      const int begin = number;
      for (std::string more; line.ends_with('\\') && !line.starts_with('#') && lines.next(more); ++number)
        line = line.substr(0, line.size() - 1).append(trimmed(more));
      try {
        take(line, source, begin, own);
      } catch (const std::invalid_argument& error) {
        throw InputError(place_of(file, begin) + ": " + error.what());
      }
    }
    if (open.size() > source.depth)
      throw InputError(place_of(file, result.openings[opened.back()].line) + ": subsection '" + open.back() +
                       "' is not closed with 'end'");
    including.erase(identity);
  }

private:
  /// A file that is being read.
  struct Source {
    fs::path file;
    std::size_t depth; ///< sections that are open around it
    std::size_t first; ///< its first setting
  };

  /// The file itself, whatever the links on the way to it are called.
  static fs::path identity_of(const fs::path& file) {
    std::error_code none;
    const fs::path whole = fs::canonical(file, none);
    return none ? file : whole; // read_text_file() says what is wrong
  }

  void check_depth(std::size_t names) const {
    if (names > deepest_section)
      throw std::invalid_argument(
          "found " + std::to_string(names) +
          " names of sections and keys inside each other, allowed: " + std::to_string(deepest_section));
  }

  /// Takes one line. @param own keys that the file has set itself, with their lines
  /// @throws std::invalid_argument: the line is none of an input
  void take(const std::string& line, const Source& source, int number, std::map<std::string, int>& own) {
    const std::string bare = line.starts_with('"') ? line : without_comment(line);
    const std::size_t blank = bare.find_first_of(" \t");
    const std::string word = bare.substr(0, blank),
                      rest = blank == std::string::npos ? "" : line.substr(blank + 1);
    if (bare.empty()) return;
    if (word == "include" && !rest.empty()) {
      include(source, number, without_comment(rest));
    } else if (word == "subsection" && blank != std::string::npos) {
      const std::vector<std::string> names = split(bare.substr(blank), '/');
      if (names.empty()) throw std::invalid_argument("found '" + bare + "', a name is missing");
      check_depth(open.size() + names.size());
      open.push_back(joined(names));
      opened.push_back(result.openings.size());
      result.openings.push_back({joined(open), source.file, number});
    } else if (bare == "end") {
      if (open.size() == source.depth) throw std::invalid_argument("'end' without an open subsection");
      open.pop_back();
      opened.pop_back();
    } else if (word == "set" && bare.find('=') != std::string::npos) {
      std::vector<std::string> names = open;
      for (const std::string& name : split(bare.substr(4, bare.find('=') - 4), '/')) names.push_back(name);
      if (names.size() == open.size()) throw std::invalid_argument("found '" + bare + "', a key is missing");
      check_depth(names.size());
      if (const auto [at, is_new] = own.try_emplace(joined(names), number); !is_new)
        throw std::invalid_argument("the key '" + joined(names) +
                                    "' is set twice in this file, first in line " +
                                    std::to_string(at->second));
      const std::string key = names.back();
      names.pop_back();
      result.settings.push_back(
          {joined(names), key, without_comment(line.substr(line.find('=') + 1)), source.file, number});
    } else {
      // Lines of an included file that is no input are nobody's business: an input of someone else may name
      // it.
      const bool shown = including.size() == 1 || source.file.extension() == ".prm";
      throw std::invalid_argument("found " + (shown ? "'" + bare + "'" : "another line") +
                                  ", allowed: subsection NAME, set KEY = VALUE, end, include FILE");
    }
  }

  void include(const Source& source, int line, const std::string& name) {
    const fs::path included = source.file.parent_path() / name;
    if (const std::string fault = fault_of_file(included); !fault.empty())
      throw InputError(place_of(source.file, line) + ": include: '" + included.string() + "' " + fault);
    const std::size_t before = result.settings.size();
    read(included);
    warn_of_replaced(source, line, name, before);
  }

  /// Warns of every key that a file has set before the setting `before`, and the include after it to another
  /// value.
  void warn_of_replaced(const Source& source, int line, const std::string& name, std::size_t before) {
    std::map<std::string, const InputText::Setting*> own, theirs;
    for (std::size_t i = source.first; i < result.settings.size(); ++i) {
      const InputText::Setting& setting = result.settings[i];
      if (i >= before || setting.file == source.file)
        (i < before ? own : theirs)[setting.section + "/" + setting.key] = &setting;
    }
    for (const auto& [key, mine] : own)
      if (const auto found = theirs.find(key); found != theirs.end() && found->second->value != mine->value)
        result.warnings.push_back(place_of(source.file, line) + ": include '" + name + "' sets '" + key +
                                  "' to '" + found->second->value + "', which replaces the '" + mine->value +
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
