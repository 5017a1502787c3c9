#pragma once

#include <string>

namespace spall {

/// Physical dimensions an input can have. Values are SI inside; files carry the unit (`set Thickness = 127
/// mm`).
enum class Dimension {
  none,             ///< a pure number
  length,           ///< m
  time,             ///< s
  mass,             ///< kg
  velocity,         ///< m/s
  stress,           ///< Pa
  inverse_stress,   ///< 1/Pa
  density,          ///< kg/m^3
  energy_per_area,  ///< J/m^2 = N/m
  rate,             ///< 1/s
  angle,            ///< rad
  moment_of_inertia ///< kg m^2
};

/// SI unit of a dimension, as printed ("m/s", "1" for none).
std::string si_unit(Dimension dimension);

/// All units accepted for a dimension, comma separated, for messages.
std::string accepted_units(Dimension dimension);

/// Value in SI of a text such as "127 mm" or "0.3".
/// @throws std::invalid_argument with a short reason if the number or the unit is wrong or missing.
double parse_quantity(const std::string& text, Dimension dimension);

/// Shortest text that parses back to the same value, in the SI unit ("0.127 m").
std::string format_quantity(double value, Dimension dimension);

} // namespace spall
