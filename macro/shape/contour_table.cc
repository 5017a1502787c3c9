#include "macro/shape/contour_table.h"

#include "shared/error.h"

#include <fstream>
#include <sstream>

namespace spall {
namespace {

struct Row {
  ContourPoint at;
  int line;
};

/// Numbers of a line "z,r"; false if it is something else.
bool parse(const std::string& text, ContourPoint& point) {
  std::istringstream stream(text);
  char comma = 0;
  stream >> point.z >> comma >> point.r;
  if (!stream || comma != ',') return false;
  stream >> std::ws;
  return stream.eof() && std::isfinite(point.z) && std::isfinite(point.r);
}

class TableReader {
public:
  explicit TableReader(const std::filesystem::path& file_) : file(file_) {}

  std::vector<Row> rows() const {
    std::ifstream stream(file);
    if (!stream) throw InputError(file.string() + ": cannot be read");
    std::vector<Row> found;
    std::string text;
    bool header = false;
    for (int line = 1; std::getline(stream, text); ++line) {
      std::erase_if(text, [](char c) { return c == '\r' || c == ' ' || c == '\t'; });
      if (text.empty() || text[0] == '#') continue;
      if (!header) {
        if (text != "z,r") refuse(line, "found '" + text + "', expected the header 'z,r'");
        header = true;
        continue;
      }
      Row row{.at = {}, .line = line};
      if (!parse(text, row.at)) refuse(line, "found '" + text + "', expected two numbers 'z,r' in m");
      if (row.at.r < 0) refuse(line, "found r = " + number(row.at.r) + ", allowed: not negative");
      found.push_back(row);
    }
    if (found.size() < 3) throw InputError(file.string() + ": a contour has at least 3 rows");
    return found;
  }
  [[noreturn]] void refuse(int line, const std::string& why) const {
    throw InputError(file.string() + ":" + std::to_string(line) + ": " + why);
  }
  static std::string number(double value) {
    std::ostringstream stream;
    stream << value;
    return stream.str();
  }

private:
  std::filesystem::path file;
};

} // namespace

Contour read_contour(const std::filesystem::path& file) {
  const TableReader reader(file);
  std::vector<Row> rows = reader.rows();
  const double way = rows.back().at.z - rows.front().at.z;
  if (way == 0) reader.refuse(rows.back().line, "the body has no length: first and last z are equal");
  for (const Row* end : {&rows.front(), &rows.back()})
    if (end->at.r != 0)
      reader.refuse(end->line, "the contour does not close: found r = " + TableReader::number(end->at.r) +
                                   " at its end, allowed: 0 (on the axis)");
  for (std::size_t k = 1; k < rows.size(); ++k) {
    if ((rows[k].at.z - rows[k - 1].at.z) * way < 0)
      reader.refuse(rows[k].line, "z turns back: it must go from one end of the body to the other");
    if (k + 1 < rows.size() && !(rows[k].at.r > 0))
      reader.refuse(rows[k].line, "found r = 0 between the ends: the body would fall apart");
  }
  if (way > 0) std::reverse(rows.begin(), rows.end());
  const double tip = rows.front().at.z;
  ContourBuilder contour({0, rows.front().at.r});
  for (const Row& row : rows) contour.line_to({row.at.z - tip, row.at.r});
  return contour.contour();
}

} // namespace spall
