#include "macro/material/strain_path.h"

#include "shared/error.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <sstream>
#include <string>

namespace spall {
namespace {

constexpr std::array<const char*, 7> columns = {"time", "exx", "eyy", "ezz", "exy", "eyz", "exz"};

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells;
  std::stringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) {
    const auto begin = cell.find_first_not_of(" \t\r");
    cells.push_back(
        begin == std::string::npos ? "" : cell.substr(begin, cell.find_last_not_of(" \t\r") - begin + 1));
  }
  return cells;
}

/// For each of our columns its place in the file.
std::array<std::size_t, 7> places(const std::vector<std::string>& header, const std::string& where) {
  std::array<std::size_t, 7> place{};
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const auto found = std::find(header.begin(), header.end(), columns[c]);
    if (found == header.end())
      throw InputError(where + ": column '" + std::string(columns[c]) + "' is missing");
    place[c] = found - header.begin();
  }
  if (header.size() != columns.size())
    for (const std::string& name : header)
      if (std::count(header.begin(), header.end(), name) > 1 ||
          std::find(columns.begin(), columns.end(), name) == columns.end())
        throw InputError(where + ": found column '" + name +
                         "' unexpectedly, allowed: time, exx, eyy, ezz, exy, eyz, exz, once each");
  return place;
}

} // namespace

std::vector<PathRow> read_strain_path(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) throw InputError(file.string() + ": cannot be opened");
  std::vector<PathRow> rows;
  std::array<std::size_t, 7> place{};
  bool header_read = false;
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    const std::string where = file.string() + ":" + std::to_string(++number);
    const std::vector<std::string> cells = split(line);
    if (cells.empty() || (cells.size() == 1 && cells[0].empty()) || cells[0].starts_with("#")) continue;
    if (!header_read) {
      place = places(cells, where);
      header_read = true;
      continue;
    }
    if (cells.size() != columns.size())
      throw InputError(where + ": found " + std::to_string(cells.size()) +
                       " values, allowed: " + std::to_string(columns.size()));
    std::array<double, 7> value{};
    for (std::size_t c = 0; c < columns.size(); ++c) try {
        value[c] = parse_quantity(cells[place[c]], Dimension::none);
      } catch (const std::invalid_argument&) {
        throw InputError(where + ": column '" + columns[c] + "': found '" + cells[place[c]] +
                         "', allowed: a number");
      }
    PathRow row{value[0], {}};
    std::copy(value.begin() + 1, value.end(), row.strain.begin());
    if (rows.empty() && row.strain != Sym3{}) {
      if (!(row.time > 0))
        throw InputError(where + ": column 'time': found '" + cells[place[0]] +
                         "', allowed: > 0 in a first row that is strained already");
      rows.push_back({0, {}});
    }
    if (!rows.empty() && !(row.time > rows.back().time))
      throw InputError(where + ": column 'time': found '" + cells[place[0]] +
                       "', allowed: larger than in the row before");
    rows.push_back(row);
  }
  if (rows.size() < 2) throw InputError(file.string() + ": holds no strained row");
  return rows;
}

void PathOptions::declare(Parameters& parameters, Needed spacing_needed) {
  auto section = parameters.section("Path", std::move(spacing_needed));
  section.integer("Substeps", substeps, {1, 1e6},
                  "steps from one row of the path to the next; the fewest, if Tolerance is not 0");
  section.number("Tolerance", tolerance, {0, 0.1},
                 "steps from row to row are halved until stress (over the largest so far) and work (over all "
                 "work exchanged so far) change by less; 0: exactly Substeps steps");
  section.choice(
      "Lateral", lateral, {{"strain", Lateral::strain}, {"stress free", Lateral::stress_free}},
      "normal strains eyy and ezz: those of the path, or (no shear) those that keep syy = szz = 0");
  section.quantity("Spacing", spacing, Dimension::length, {above_zero},
                   "edge of the cell the point stands for; must be set if there is a damage table, and is "
                   "the reference length "
                   "of shear damage if it is not");
}

} // namespace spall
