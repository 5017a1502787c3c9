#include "shared/input/words.h"

#include <algorithm>
#include <cctype>
#include <stdexcept>

namespace spall {
namespace {

constexpr const char* blanks = " \t\r";

/// Reads a text in double quotes that begins at `place`, and moves `place` behind the closing one.
std::string read_quoted(const std::string& text, std::size_t& place) {
  std::string inside;
  for (++place; place < text.size(); ++place) {
    if (text[place] != '"') {
      inside += text[place];
    } else if (place + 1 < text.size() && text[place + 1] == '"') {
      inside += text[++place];
    } else {
      ++place;
      return inside;
    }
  }
  throw std::invalid_argument("a double quote is not closed");
}

std::invalid_argument after_quote(const std::string& rest) {
  return std::invalid_argument("found '" + rest + "' after a closing double quote");
}

/// Place of the # that begins a comment, or the size of the text.
std::size_t comment_in(const std::string& text) {
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text[i] == '#' && (i == 0 || text[i - 1] == ' ' || text[i - 1] == '\t')) return i;
  return text.size();
}

} // namespace

std::string trimmed(const std::string& text) {
  const auto begin = text.find_first_not_of(blanks);
  return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

std::string lower_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    if (const std::string part = trimmed(text.substr(begin, end - begin)); !part.empty())
      parts.push_back(part);
    begin = end + 1;
  }
  return parts;
}

std::vector<std::string> list_of(const std::string& text) {
  const std::vector<std::string> items = split(text);
  if (trimmed(text).empty()) return items;
  if (items.size() != 1 + static_cast<std::size_t>(std::count(text.begin(), text.end(), ',')))
    throw std::invalid_argument("an item of the list is empty");
  for (auto item = items.begin(); item != items.end(); ++item)
    if (std::find(items.begin(), item, *item) != item)
      throw std::invalid_argument("'" + *item + "' stands there twice");
  return items;
}

std::vector<std::string> cells_of(const std::string& line, char separator) {
  std::vector<std::string> cells;
  for (std::size_t place = 0; place <= line.size(); ++place) { // past the separator
    place = std::min(line.find_first_not_of(" \r", place), line.size());
    const bool in_quotes = place < line.size() && line[place] == '"';
    std::string cell = in_quotes ? read_quoted(line, place) : "";
    const std::size_t end = std::min(line.find(separator, place), line.size());
    const std::string rest = trimmed(line.substr(place, end - place));
    if (in_quotes && !rest.empty()) throw after_quote(rest);
    cells.push_back(in_quotes ? trimmed(cell) : rest);
    place = end;
  }
  return cells;
}

std::string without_comment(const std::string& text) {
  const std::string whole = trimmed(text);
  if (!whole.starts_with('"')) return trimmed(whole.substr(0, comment_in(whole)));
  std::size_t place = 0;
  std::string inside = read_quoted(whole, place);
  if (const std::string rest = trimmed(whole.substr(place)); !rest.empty() && rest[0] != '#')
    throw after_quote(rest);
  return inside;
}

std::string quoted_if_needed(const std::string& text) {
  const bool plain = trimmed(text) == text && comment_in(text) == text.size() && !text.starts_with('"') &&
                     !text.ends_with('\\');
  if (plain) return text;
  std::string inside;
  for (const char c : text) inside += c == '"' ? "\"\"" : std::string(1, c);
  return '"' + inside + '"';
}

std::string joined(const std::vector<std::string>& words, const std::string& between) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

} // namespace spall
