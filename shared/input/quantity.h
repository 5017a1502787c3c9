#pragma once

#include <string>

namespace spall {

/// Physical dimensions an input can have. The program uses SI; files state the unit (`set Thickness = 127
/// mm`).
enum class Dimension {
  none,              ///< a number without unit
  length,            ///< m
  time,              ///< s
  mass,              ///< kg
  velocity,          ///< m/s
  stress,            ///< Pa
  inverse_stress,    ///< 1/Pa
  density,           ///< kg/m^3
  energy_per_area,   ///< J/m^2 = N/m
  rate,              ///< 1/s
  angle,             ///< rad
  angular_velocity,  ///< rad/s
  moment_of_inertia, ///< kg m^2
  temperature,       ///< K
  specific_heat      ///< J/(kg K)
};

/// Returns the SI unit of a dimension as it is printed ("m/s", "1" for none).
std::string si_unit(Dimension dimension);

/// Returns all units accepted for a dimension, separated by commas, for messages.
std::string accepted_units(Dimension dimension);

/// Sizes that quantities of a dimension can have, in SI: the smallest one that is not zero, and the largest.
struct Magnitudes {
  double smallest, largest;
};
Magnitudes magnitudes(Dimension dimension);

/// Returns a number with an optional sign, and sets `unit` to what follows it, without blanks around it.
/// @throws std::invalid_argument if the text does not begin with a finite number
double parse_number(const std::string& text, std::string& unit);

/// Returns a whole number with an optional sign. @throws std::invalid_argument
int parse_integer(const std::string& text);

/// Returns whether a comma stands between two digits, as in 0,5: it may be meant as a decimal comma.
bool has_decimal_comma(const std::string& text);

/// Returns the value in SI of a text such as "127 mm" or "0.3".
/// @throws std::invalid_argument with a short reason if the number or the unit is wrong or missing.
double parse_quantity(const std::string& text, Dimension dimension);

/// Returns a number in six digits, readable however large or small it is: for messages.
std::string in_six_digits(double value);

/// Returns the shortest text that parses back to the same value, in the SI unit ("0.127 m").
std::string format_quantity(double value, Dimension dimension);

} // namespace spall
