#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace spall {

/// A row of a table and the line of the file where it stands.
struct NumberRow {
  int line;
  std::vector<double> values; ///< in the order of the columns asked for
};

/// Reads a CSV file of numbers. The first line names the columns, in any order: each of `columns` once, no
/// other ones; capitals, blanks and double quotes around names and numbers do not matter. Cells are separated
/// by commas, or by semicolons if the first line has no comma; numbers have a decimal point. Empty lines and
/// those that begin with # are left out.
/// @throws InputError: file, line, column, found, allowed.
std::vector<NumberRow> read_number_rows(const std::filesystem::path& file,
                                        const std::vector<std::string>& columns);

} // namespace spall
