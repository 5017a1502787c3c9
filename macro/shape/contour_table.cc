#include "macro/shape/contour_table.h"

#include "shared/error.h"
#include "shared/input/number_rows.h"
#include "shared/input/quantity.h"

#include <algorithm>
#include <string>
#include <vector>

namespace spall {
namespace {

struct Row {
  ContourPoint at;
  int line;
};

[[noreturn]] void refuse(const std::filesystem::path& file, int line, const std::string& why) {
  throw InputError(file.string() + ":" + std::to_string(line) + ": " + why);
}

std::string number(double value) { return format_quantity(value, Dimension::none); }

std::vector<Row> read_corners(const std::filesystem::path& file) {
  std::vector<Row> rows;
  for (const auto& [line, values] : read_number_rows(file, {"z", "r"})) {
    if (values[1] < 0) refuse(file, line, "found r = " + number(values[1]) + ", allowed: not negative");
    rows.push_back({{.z = values[0], .r = values[1]}, line});
  }
  if (rows.size() < 3) throw InputError(file.string() + ": a contour has at least 3 rows");
  return rows;
}

} // namespace

Contour read_contour(const std::filesystem::path& file) {
  std::vector<Row> rows = read_corners(file);
  const double way = rows.back().at.z - rows.front().at.z;
  if (way == 0) refuse(file, rows.back().line, "the body has no length: first and last z are equal");
  for (const Row* end : {&rows.front(), &rows.back()})
    if (end->at.r != 0)
      refuse(file, end->line,
             "the contour does not close: found r = " + number(end->at.r) +
                 " at its end, allowed: 0 (on the axis)");
  for (std::size_t k = 1; k < rows.size(); ++k) {
    if ((rows[k].at.z - rows[k - 1].at.z) * way < 0)
      refuse(file, rows[k].line, "z turns back: it must go from one end of the body to the other");
    if (k + 1 < rows.size() && !(rows[k].at.r > 0))
      refuse(file, rows[k].line, "found r = 0 between the ends: the body would fall apart");
  }
  if (way > 0) std::reverse(rows.begin(), rows.end());
  const double tip = rows.front().at.z;
  ContourBuilder contour({0, rows.front().at.r});
  for (const Row& row : rows) contour.line_to({row.at.z - tip, row.at.r});
  return contour.contour();
}

} // namespace spall
