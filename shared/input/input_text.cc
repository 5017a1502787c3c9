#include "shared/input/input_text.h"

#include "shared/error.h"

#include <fstream>
#include <regex>
#include <set>
#include <sstream>

namespace spall {
namespace {

namespace fs = std::filesystem;

std::string joined(const std::vector<std::string>& names) {
  std::string path;
  for (const std::string& name : names) path += (path.empty() ? "" : "/") + name;
  return path;
}

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
    const std::size_t depth = open.size();
    std::vector<int> opened; // lines that opened the sections
    begin_part(file, 1);
    int number = 0;
    for (std::string line; std::getline(stream, line);) {
      if (++number == 1 && line.starts_with("\xEF\xBB\xBF"))
        line.erase(0, 3);                        // byte order mark of some editors
      if (line.ends_with('\r')) line.pop_back(); // line ends of Windows
      const std::string where = file.string() + ":" + std::to_string(number) + ": ";
      const std::string bare = line.substr(0, line.find('#'));
      static const std::regex include("\\s*include\\s+(.*?)\\s*"), subsection("\\s*subsection\\s+(.*?)\\s*"),
          end("\\s*end\\s*"), set_inside("\\s*set\\s+([^=]*)/([^=/]*=.*)");
      std::smatch m;
      if (std::regex_match(bare, m, include)) {
        const fs::path included = file.parent_path() / m[1].str();
        if (!fs::is_regular_file(included))
          throw InputError(where + "include: '" + included.string() + "' does not exist");
        read(included);
        begin_part(file, number + 1);
        continue;
      }
      if (std::regex_match(bare, m, set_inside)) { // set Section/Key = value: as on the command line
        set_in_section(file, number, m[1], m[2]);
        continue;
      }
      result.parts.back().text += line + "\n";
      if (std::regex_match(bare, m, subsection)) {
        open.push_back(m[1]);
        opened.push_back(number);
        result.openings.push_back({joined(open), file, number});
      } else if (std::regex_match(bare, end)) {
        if (open.size() == depth) throw InputError(where + "'end' without an open subsection");
        open.pop_back();
        opened.pop_back();
      }
    }
    if (open.size() > depth)
      throw InputError(file.string() + ":" + std::to_string(opened.back()) + ": subsection '" + open.back() +
                       "' is not closed with 'end'");
    including.erase(identity);
  }

private:
  /// A key of a section that is not open here, as a part of its own.
  void set_in_section(const fs::path& file, int line, const std::string& section, const std::string& rest) {
    begin_part(file, line);
    std::istringstream names(section);
    for (std::string name; std::getline(names, name, '/');) result.parts.back().open.push_back(name);
    result.parts.back().text = "set " + rest + "\n";
    begin_part(file, line + 1);
  }
  void begin_part(const fs::path& file, int line) { result.parts.push_back({file, line, open, ""}); }

  InputText& result;
  std::vector<std::string> open;
  std::set<fs::path> including; ///< chain of including files from the first one to the one being read
};

} // namespace

InputText InputText::read(const fs::path& file) {
  InputText text{.file = file, .parts = {}, .openings = {}};
  Reader(text).read(file);
  return text;
}

} // namespace spall
