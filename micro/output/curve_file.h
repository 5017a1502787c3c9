#pragma once

#include "shared/damage_table.h"

#include <filesystem>
#include <string>

namespace spall {

/// Writes one curve as `.csv`: a header line with the names of damage_columns, then one row per state, SI. A
/// curve that ended early carries the reason as a last line that starts with `# incomplete: `.
void write_curve(const DamageCurve& curve, const std::string& incomplete, const std::filesystem::path& file);

} // namespace spall
