#pragma once

#include <string>
#include <vector>

namespace spall {

/// Levenshtein distance of two words: the fewest letters to insert, delete or replace.
std::size_t edit_distance(const std::string& a, const std::string& b);

/// Returns the place of the candidate nearest to a misspelt word, whatever its capitals, or the number of
/// candidates if none is near: more than half of its letters would have to change.
std::size_t nearest_of(const std::string& word, const std::vector<std::string>& candidates);

/// Returns " (did you mean 'WORD'?)" with the candidate nearest to a misspelt word, or "" if none is near.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& candidates);

} // namespace spall
