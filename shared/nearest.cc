#include "shared/nearest.h"

#include "shared/input/words.h"

#include <algorithm>
#include <numeric>

namespace spall {

std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1); // distances of the first letters of a from the first ones of b
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 1; j < row.size(); ++j) {
      const std::size_t change = diagonal + (a[i - 1] != b[j - 1]);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, change});
    }
  }
  return row.back();
}

std::size_t nearest_of(const std::string& word, const std::vector<std::string>& candidates) {
  const std::string wanted = lower_case(word);
  std::size_t best = candidates.size(), least = word.size() / 2 + 1;
  for (std::size_t i = 0; i < candidates.size(); ++i)
    if (const std::size_t distance = edit_distance(wanted, lower_case(candidates[i])); distance < least)
      best = i, least = distance;
  return best;
}

std::string did_you_mean(const std::string& word, const std::vector<std::string>& candidates) {
  const std::size_t best = nearest_of(word, candidates);
  return best == candidates.size() ? "" : " (did you mean '" + candidates[best] + "'?)";
}

} // namespace spall
