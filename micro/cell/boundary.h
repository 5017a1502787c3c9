#pragma once

#include <string>
#include <utility>
#include <vector>

namespace spall {

/// How the cell hangs in its surroundings.
enum class Boundary {
  periodic,            ///< fluctuations repeat
  linear_displacement, ///< no fluctuation on the edge: no crack can cross it
  uniform_traction     ///< the edge carries the mean stress and moves as it likes
};

inline const std::vector<std::pair<std::string, Boundary>>& boundary_words() {
  static const std::vector<std::pair<std::string, Boundary>> words = {
      {"periodic", Boundary::periodic},
      {"linear displacement", Boundary::linear_displacement},
      {"uniform traction", Boundary::uniform_traction}};
  return words;
}

} // namespace spall
