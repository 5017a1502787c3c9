#include "shared/input/visible.h"

#include <array>
#include <cstdint>
#include <cstdio>

namespace spall {
namespace {

unsigned char byte_of(const std::string& text, std::size_t place) {
  return static_cast<unsigned char>(text[place]);
}

/// The number of the character of `length` bytes at `place`.
std::uint32_t code_point(const std::string& text, std::size_t place, std::size_t length) {
  static constexpr std::array<unsigned, 5> mask = {0, 0x7f, 0x1f, 0x0f, 0x07};
  std::uint32_t code = byte_of(text, place) & mask[length];
  for (std::size_t i = 1; i < length; ++i) code = code << 6 | (byte_of(text, place + i) & 0x3fU);
  return code;
}

/// Whether a terminal does something else with a character than showing it.
bool is_obeyed(std::uint32_t code) {
  return code < 0x20 || (code >= 0x7f && code < 0xa0) || (code >= 0x200b && code <= 0x200f) ||
         (code >= 0x2028 && code <= 0x202e) || (code >= 0x2060 && code <= 0x206f) || code == 0xfeff;
}

std::string escaped(std::uint32_t code, bool is_byte) {
  if (code == '\n') return "\\n";
  if (code == '\t') return "\\t";
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), is_byte || code < 0x80 ? "\\x%02x" : "\\u%04x",
                static_cast<unsigned>(code));
  return text.data();
}

} // namespace

std::size_t utf8_length(const std::string& text, std::size_t place) {
  const unsigned char first = byte_of(text, place);
  const std::size_t length = first < 0x80                    ? 1
                             : first >= 0xc2 && first < 0xe0 ? 2
                             : first >= 0xe0 && first < 0xf0 ? 3
                             : first >= 0xf0 && first < 0xf5 ? 4
                                                             : 0;
  if (length == 0 || place + length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte_of(text, place + i) & 0xc0) != 0x80) return 0;
  const std::uint32_t code = code_point(text, place, length);
  // Forms that are too long, halves of UTF-16 pairs, and numbers beyond the last character are none.
  const bool is_none = (length == 3 && (code < 0x800 || (code >= 0xd800 && code < 0xe000))) ||
                       (length == 4 && (code < 0x10000 || code > 0x10ffff));
  return is_none ? 0 : length;
}

std::string visible(const std::string& text) {
  std::string shown;
  for (std::size_t place = 0; place < text.size();) {
    const std::size_t length = utf8_length(text, place);
    const std::uint32_t code = length == 0 ? byte_of(text, place) : code_point(text, place, length);
    if (length == 0 || is_obeyed(code))
      shown += escaped(code, length == 0);
    else
      shown += text.substr(place, length);
    place += length == 0 ? 1 : length;
  }
  return shown;
}

std::string shortened(const std::string& text, std::size_t most) {
  if (text.size() <= most) return text;
  std::size_t begin = most / 2, end = text.size() - most / 2;
  const auto is_inside = [&](std::size_t at) { return (byte_of(text, at) & 0xc0) == 0x80; };
  while (begin > 0 && is_inside(begin)) --begin;
  while (end < text.size() && is_inside(end)) ++end;
  return text.substr(0, begin) + " [... " + std::to_string(end - begin) + " bytes ...] " + text.substr(end);
}

} // namespace spall
