#include "shared/summary.h"

#include "shared/input/quantity.h"
#include "shared/input/visible.h"
#include "shared/output_directory.h"

#include <algorithm>
#include <cmath>

namespace spall {
namespace {

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (std::size_t place = 0; place < text.size(); ++place) {
    const char c = text[place];
    if (static_cast<unsigned char>(c) >= 0x80) { // JSON is UTF-8: names of files need not be
      const std::size_t length = utf8_length(text, place);
      out += length > 0 ? text.substr(place, length) : "\\ufffd";
      place += length > 0 ? length - 1 : 0;
      continue;
    }
    if (c == '"' || c == '\\')
      out += std::string("\\") + c;
    else if (static_cast<unsigned char>(c) < 0x20)
      out += c == '\n' ? "\\n" : " ";
    else
      out += c;
  }
  return out + "\"";
}

} // namespace

void Summary::set_raw(const std::string& key, const std::string& text) {
  const auto found =
      std::find_if(entries.begin(), entries.end(), [&](const auto& e) { return e.first == key; });
  if (found != entries.end())
    found->second = text;
  else
    entries.emplace_back(key, text);
}

void Summary::set(const std::string& key, double value) {
  set_raw(key, std::isfinite(value) ? format_quantity(value, Dimension::none) : "null");
}

void Summary::set(const std::string& key, const std::string& value) { set_raw(key, quoted(value)); }

void Summary::add(const Summary& other) {
  for (const auto& [key, value] : other.entries) set_raw(key, value);
}

void Summary::forget_values() {
  for (auto& [key, value] : entries) value = "null";
}

std::string Summary::json() const {
  std::string text = "{\n";
  for (const auto& [key, value] : entries)
    text += "  " + quoted(key) + ": " + value + (key == entries.back().first ? "\n" : ",\n");
  return text + "}\n";
}

void Summary::write(const std::filesystem::path& file) const { write_atomically(file, json()); }

} // namespace spall
