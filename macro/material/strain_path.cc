#include "macro/material/strain_path.h"

#include "shared/error.h"
#include "shared/input/number_rows.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace spall {
namespace {

/// Small strains, which add up from row to row: a path of several hundred percent is a slip of the pen, such
/// as percent without their sign.
constexpr double largest_path_strain = 1;

} // namespace

std::vector<PathRow> read_strain_path(const std::filesystem::path& file) {
  std::vector<PathRow> rows;
  const std::vector<std::string> columns = {"time", "exx", "eyy", "ezz", "exy", "eyz", "exz"};
  for (const NumberRow& numbers : read_number_rows(file, columns)) {
    PathRow row{numbers.values[0], {}};
    std::copy(numbers.values.begin() + 1, numbers.values.end(), row.strain.begin());
    const auto refuse = [&](const std::string& allowed) {
      throw InputError(file.string() + ":" + std::to_string(numbers.line) + ": column 'time': found '" +
                       format_quantity(row.time, Dimension::none) + "', allowed: " + allowed);
    };
    for (std::size_t c = 0; c < row.strain.size(); ++c)
      if (std::abs(row.strain[c]) > largest_path_strain)
        throw InputError(file.string() + ":" + std::to_string(numbers.line) + ": column '" + columns[c + 1] +
                         "': found '" + format_quantity(row.strain[c], Dimension::none) + "', allowed: -" +
                         format_quantity(largest_path_strain, Dimension::none) + " to " +
                         format_quantity(largest_path_strain, Dimension::none));
    if (std::abs(row.time) > magnitudes(Dimension::time).largest)
      refuse("at most " + format_quantity(magnitudes(Dimension::time).largest, Dimension::none));
    if (rows.empty() && row.strain != Sym3{}) {
      if (!(row.time > 0)) refuse("> 0 in a first row that is strained already");
      rows.push_back({0, {}});
    }
    if (!rows.empty() && !(row.time > rows.back().time)) refuse("larger than in the row before");
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
