#pragma once

#include <algorithm>
#include <string>
#include <vector>

namespace spall {

/// The names in a list that is separated by commas, without the blanks around them.
inline std::vector<std::string> names_of(const std::string& list) {
  std::vector<std::string> names;
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    const std::size_t first = list.find_first_not_of(" \t", begin),
                      last = list.find_last_not_of(" \t", end - 1);
    if (first < end) names.push_back(list.substr(first, last - first + 1));
    begin = end + 1;
  }
  return names;
}

/// A name as part of a key of summary.json: blanks become underscores.
inline std::string key_of(std::string name) {
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

} // namespace spall
