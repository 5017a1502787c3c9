#include "shared/input/number_rows.h"

#include "shared/error.h"
#include "shared/input/quantity.h"
#include "shared/input/text_file.h"
#include "shared/input/words.h"

#include <algorithm>
#include <stdexcept>

namespace spall {
namespace {

/// Reads the lines of one table.
class RowReader {
public:
  /// @param shown_ whether messages may show lines of the file
  RowReader(const std::vector<std::string>& columns_, bool shown_) : columns(columns_), shown(shown_) {}

  /// Takes the line with the names of the columns. @throws std::invalid_argument
  void take_names(const std::string& line) {
    separator = line.find(',') == std::string::npos && line.find(';') != std::string::npos ? ';' : ',';
    std::vector<std::string> names = cells_of(line, separator);
    for (std::string& name : names) name = lower_case(name);
    for (const std::string& column : columns) {
      const auto found = std::find(names.begin(), names.end(), column);
      if (found == names.end())
        throw std::invalid_argument("column '" + column + "' is missing, found: " +
                                    (shown ? "'" + line + "'" : "another line") + ", " + allowed());
      places.push_back(static_cast<std::size_t>(found - names.begin()));
    }
    for (const std::string& name : names)
      if (std::count(names.begin(), names.end(), name) > 1 ||
          std::find(columns.begin(), columns.end(), name) == columns.end())
        throw std::invalid_argument("found column '" + name + "' unexpectedly, " + allowed() + ", once each");
  }

  /// Returns the numbers of a line. @throws std::invalid_argument
  std::vector<double> numbers(const std::string& line) const {
    const std::vector<std::string> cells = cells_of(line, separator);
    if (cells.size() != columns.size())
      throw std::invalid_argument("found " + std::to_string(cells.size()) +
                                  " values, allowed: " + std::to_string(columns.size()) +
                                  (cells.size() > columns.size() ? " with a decimal point, no comma" : ""));
    std::vector<double> values;
    for (std::size_t c = 0; c < columns.size(); ++c) try {
        values.push_back(parse_quantity(cells[places[c]], Dimension::none));
      } catch (const std::invalid_argument&) {
        const std::string& cell = cells[places[c]];
        throw std::invalid_argument("column '" + columns[c] + "': found '" + cell + "', allowed: a number" +
                                    (has_decimal_comma(cell) ? " with a decimal point, no comma" : ""));
      }
    return values;
  }

private:
  std::string allowed() const {
    std::string text = "allowed: ";
    for (const std::string& column : columns) text += (column == columns.front() ? "" : ",") + column;
    return text + " (or with semicolons)";
  }

  const std::vector<std::string>& columns;
  bool shown;
  char separator = ',';
  std::vector<std::size_t> places; ///< of our columns in the file
};

} // namespace

std::vector<NumberRow> read_number_rows(const std::filesystem::path& file,
                                        const std::vector<std::string>& columns) {
  Lines lines(read_text_file(file));
  // Lines of a file that is no table are nobody's business: an input of someone else may name it.
  RowReader reader(columns, lower_case(file.extension().string()) == ".csv");
  std::vector<NumberRow> rows;
  bool named = false;
  int number = 0;
  for (std::string line; lines.next(line);) {
    ++number;
    line = trimmed(line);
    if (line.empty() || line.starts_with('#')) continue;
    try {
      if (named)
        rows.push_back({number, reader.numbers(line)});
      else
        reader.take_names(line);
      named = true;
    } catch (const std::invalid_argument& error) {
      throw InputError(file.string() + ":" + std::to_string(number) + ": " + error.what());
    }
  }
  return rows;
}

} // namespace spall
