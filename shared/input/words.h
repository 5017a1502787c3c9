#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace spall {

/// What some editors write at the beginning of a file.
inline constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

/// Returns a text without the blanks, tabs and carriage returns around it.
std::string trimmed(const std::string& text);

/// Returns a text with small letters instead of capitals (ASCII).
std::string lower_case(std::string text);

/// Returns the parts of a text between the separators, trimmed; a part of blanks only is left out.
std::vector<std::string> split(const std::string& text, char separator = ',');

/// Returns the items of a list between commas, trimmed; of blanks only: none.
/// @throws std::invalid_argument: an item is empty, as behind a last comma, or stands there twice
std::vector<std::string> list_of(const std::string& text);

/// Returns the cells of a line between the separators, trimmed, also those that are empty. A cell in double
/// quotes may hold separators and blanks; "" in it is a double quote.
/// @throws std::invalid_argument: a quote that is not closed, or a text after the closing one.
std::vector<std::string> cells_of(const std::string& line, char separator);

/// Returns the text before the comment, trimmed. A comment begins with #, at the start of the text or after a
/// blank: a#b is a name. The comment of a text in double quotes begins after them, and the quotes go.
/// @throws std::invalid_argument as cells_of
std::string without_comment(const std::string& text);

/// Returns a text in the form that without_comment() gives back: in double quotes if it needs them.
std::string quoted_if_needed(const std::string& text);

/// Returns words with a text between them: by default as the names of sections stand before a key.
std::string joined(const std::vector<std::string>& words, const std::string& between = "/");

} // namespace spall
