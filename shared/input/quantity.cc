#include "shared/input/quantity.h"

#include "shared/input/words.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

namespace spall {
namespace {

struct Unit {
  const char* name;
  double factor; ///< value of the unit in SI
};

/// The first unit of each list is the SI unit.
const std::vector<Unit>& units(Dimension dimension) {
  static const std::map<Dimension, std::vector<Unit>> table = {
      {Dimension::none, {}},
      {Dimension::length, {{"m", 1}, {"mm", 1e-3}, {"cm", 1e-2}, {"um", 1e-6}}},
      {Dimension::time, {{"s", 1}, {"ms", 1e-3}, {"us", 1e-6}}},
      {Dimension::mass, {{"kg", 1}, {"g", 1e-3}}},
      {Dimension::velocity, {{"m/s", 1}, {"mm/us", 1e3}}},
      {Dimension::stress, {{"Pa", 1}, {"kPa", 1e3}, {"MPa", 1e6}, {"GPa", 1e9}}},
      {Dimension::inverse_stress, {{"1/Pa", 1}, {"1/MPa", 1e-6}, {"1/GPa", 1e-9}}},
      {Dimension::density, {{"kg/m3", 1}, {"kg/m^3", 1}, {"g/cm3", 1e3}}},
      {Dimension::energy_per_area, {{"N/m", 1}, {"J/m2", 1}, {"N/mm", 1e3}}},
      {Dimension::rate, {{"1/s", 1}, {"s^-1", 1}}},
      {Dimension::angle, {{"rad", 1}, {"deg", std::numbers::pi / 180}}},
      {Dimension::angular_velocity,
       {{"rad/s", 1}, {"deg/s", std::numbers::pi / 180}, {"rpm", std::numbers::pi / 30}}},
      {Dimension::moment_of_inertia, {{"kg m2", 1}, {"kg m^2", 1}}},
      {Dimension::temperature, {{"K", 1}}},
      {Dimension::specific_heat, {{"J/(kg K)", 1}, {"J/kg/K", 1}, {"kJ/(kg K)", 1e3}}},
  };
  return table.at(dimension);
}

/// Where the number of a trimmed text begins, for std::from_chars, which takes no plus sign.
const char* after_plus(const std::string& text) {
  const bool plus = text.size() > 1 && text[0] == '+' && text[1] != '-';
  return text.data() + (plus ? 1 : 0);
}

/// Smallest and largest sizes that bodies, materials and times of any impact have, far beyond both: numbers
/// outside are slips of the pen, and their squares and cubes leave the range of floating point.
const std::map<Dimension, Magnitudes>& magnitudes() {
  static const std::map<Dimension, Magnitudes> table = {
      {Dimension::none, {0, 1e15}},
      {Dimension::length, {1e-9, 1e6}},
      {Dimension::time, {1e-15, 1e9}},
      {Dimension::mass, {1e-12, 1e12}},
      {Dimension::velocity, {1e-9, 1e6}},
      {Dimension::stress, {1e-3, 1e15}},
      {Dimension::inverse_stress, {1e-18, 1e3}},
      {Dimension::density, {1e-3, 1e12}}, // ends that a scene holds by their mass
      {Dimension::energy_per_area, {1e-9, 1e12}},
      {Dimension::rate, {1e-15, 1e15}},
      {Dimension::angle, {1e-9, 1e3}},
      {Dimension::angular_velocity, {1e-9, 1e6}},
      {Dimension::moment_of_inertia, {1e-24, 1e12}},
      {Dimension::temperature, {1e-6, 1e6}},
      {Dimension::specific_heat, {1e-6, 1e9}},
  };
  return table;
}

} // namespace

Magnitudes magnitudes(Dimension dimension) { return magnitudes().at(dimension); }

std::string si_unit(Dimension dimension) {
  return units(dimension).empty() ? "1" : units(dimension).front().name;
}

std::string accepted_units(Dimension dimension) {
  std::string list;
  for (const Unit& unit : units(dimension)) list += (list.empty() ? "" : ", ") + std::string(unit.name);
  return list.empty() ? "none" : list;
}

double parse_number(const std::string& text, std::string& unit) {
  const std::string whole = trimmed(text);
  double value = 0;
  const auto [end, status] = std::from_chars(after_plus(whole), whole.data() + whole.size(), value);
  if (status != std::errc() || !std::isfinite(value))
    throw std::invalid_argument("'" + text + "' is not a number");
  unit = trimmed({end, whole.data() + whole.size()});
  return value;
}

int parse_integer(const std::string& text) {
  const std::string whole = trimmed(text);
  int value = 0;
  const auto [end, status] = std::from_chars(after_plus(whole), whole.data() + whole.size(), value);
  if (status != std::errc() || end != whole.data() + whole.size())
    throw std::invalid_argument("'" + text + "' is not a whole number");
  return value;
}

bool has_decimal_comma(const std::string& text) {
  const auto digit = [&](std::size_t i) { return i < text.size() && text[i] >= '0' && text[i] <= '9'; };
  for (std::size_t i = 1; i < text.size(); ++i)
    if (text[i] == ',' && digit(i - 1) && digit(i + 1)) return true;
  return false;
}

double parse_quantity(const std::string& text, Dimension dimension) {
  std::string unit;
  const double value = parse_number(text, unit);
  if (dimension == Dimension::none) {
    if (!unit.empty()) throw std::invalid_argument("a pure number takes no unit, found '" + unit + "'");
    return value;
  }
  for (const Unit& candidate : units(dimension))
    if (unit == candidate.name) {
      const double in_si = value * candidate.factor;
      if (!std::isfinite(in_si)) throw std::invalid_argument("'" + text + "' is too large");
      return in_si;
    }
  throw std::invalid_argument(
      (unit.empty() ? "the unit is missing" : "'" + unit + "' is not a unit of this key") +
      ", allowed: " + accepted_units(dimension));
}

std::string in_six_digits(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6g", value);
  return text.data();
}

std::string format_quantity(double value, Dimension dimension) {
  std::array<char, 64> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  std::string text(buffer.data(), end);
  if (dimension != Dimension::none) text += " " + si_unit(dimension);
  return text;
}

} // namespace spall
