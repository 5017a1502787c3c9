#pragma once

#include <cstddef>
#include <string>

namespace spall {

/// Characters of a message that are shown at most.
inline constexpr std::size_t longest_message = 1500;

/// Returns a text in which a terminal obeys nothing: control characters, marks that change the direction of
/// writing and bytes that are no UTF-8 become `\n`, `\t`, `\x1b`, `\u202e`. So it is one line, however
/// hostile the names and values in it are.
std::string visible(const std::string& text);

/// Returns a text without its middle if it is longer than `most` bytes: its begin says where, its end what is
/// allowed.
std::string shortened(const std::string& text, std::size_t most = longest_message);

/// The length of the UTF-8 character that begins at `place`, in bytes; 0 if none does.
std::size_t utf8_length(const std::string& text, std::size_t place);

} // namespace spall
