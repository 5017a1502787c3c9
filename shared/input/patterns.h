#pragma once

#include "shared/input/parameters.h"

#include <deal.II/base/parameter_handler.h>

#include <cmath>
#include <functional>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace spall {

/// A deal.II pattern that says in words what a key takes and checks it with a function that throws.
class Checked : public dealii::Patterns::PatternBase {
public:
  Checked(std::function<void(const std::string&)> check_, std::string words_)
      : check(std::move(check_)), words(std::move(words_)) {}
  bool match(const std::string& text) const override {
    try {
      check(text);
      return true;
    } catch (const std::invalid_argument&) {
      return false;
    }
  }
  std::string description(OutputStyle = Machine) const override { return words; }
  std::unique_ptr<PatternBase> clone() const override { return std::make_unique<Checked>(*this); }

private:
  std::function<void(const std::string&)> check;
  std::string words;
};

inline std::string range_words(Range range, Dimension dimension) {
  std::string words;
  if (range.min == above_zero)
    words = "> 0";
  else if (std::isfinite(range.min))
    words = ">= " + format_quantity(range.min, dimension);
  if (std::isfinite(range.max))
    words += std::string(words.empty() ? "" : " and ") + "<= " + format_quantity(range.max, dimension);
  return words.empty() ? "any value" : words;
}

inline double in_range(double value, Range range) {
  if (!(value >= range.min && value <= range.max)) throw std::invalid_argument("out of range");
  return value;
}

inline std::vector<std::string> split(const std::string& text, char separator = ',') {
  std::vector<std::string> items;
  std::stringstream stream(text);
  for (std::string item; std::getline(stream, item, separator);) {
    const auto begin = item.find_first_not_of(" \t");
    if (begin == std::string::npos) continue;
    items.push_back(item.substr(begin, item.find_last_not_of(" \t") - begin + 1));
  }
  return items;
}

} // namespace spall
