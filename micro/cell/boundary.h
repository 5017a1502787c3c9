#pragma once

#include <string>
#include <utility>
#include <vector>

namespace spall {

/// Boundary condition of the cell.
enum class Boundary {
  periodic,            ///< displacement fluctuations are periodic
  linear_displacement, ///< the fluctuation is zero on the edge, so that no crack can cross it
  uniform_traction     ///< the traction on the edge is the one that belongs to the mean stress
};

inline const std::vector<std::pair<std::string, Boundary>>& boundary_words() {
  static const std::vector<std::pair<std::string, Boundary>> words = {
      {"periodic", Boundary::periodic},
      {"linear displacement", Boundary::linear_displacement},
      {"uniform traction", Boundary::uniform_traction}};
  return words;
}

} // namespace spall
