#pragma once

#include <algorithm>
#include <string>

namespace spall {

/// A name as part of a key of summary.json: blanks become underscores.
inline std::string key_of(std::string name) {
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

} // namespace spall
