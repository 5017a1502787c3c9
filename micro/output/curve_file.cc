#include "micro/output/curve_file.h"

#include "shared/input/quantity.h"
#include "shared/output_directory.h"

namespace spall {

void write_curve(const DamageCurve& curve, const std::string& incomplete, const std::filesystem::path& file) {
  std::string text;
  for (const DamageColumn& column : damage_columns)
    text += std::string(text.empty() ? "" : ",") + column.name;
  text += "\n";
  for (std::size_t row = 0; row < curve.strain.size(); ++row) {
    std::string line;
    for (const DamageColumn& column : damage_columns)
      line += (line.empty() ? "" : ",") + format_quantity((curve.*column.values)[row], Dimension::none);
    text += line + "\n";
  }
  if (!incomplete.empty()) text += "# incomplete: " + incomplete + "\n";
  write_atomically(file, text);
}

} // namespace spall
