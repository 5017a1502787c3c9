#pragma once

#include <string>
#include <vector>

namespace spall {

/// Levenshtein distance of two words: the fewest letters to insert, delete or replace.
std::size_t edit_distance(const std::string& a, const std::string& b);

/// Returns " (did you mean 'WORD'?)" with the candidate nearest to a misspelt word, or "" if none is near:
/// more than half of its letters would have to change.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& candidates);

} // namespace spall
