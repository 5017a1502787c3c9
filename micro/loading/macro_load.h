#pragma once

#include "micro/equilibrium/condensed_cell.h"

#include <array>

namespace spall {

/// What is done to the cell as a whole: its strain grows along `direction`; components of strain that are
/// `free` take the value at which their stress vanishes.
struct MacroLoad {
  Voigt direction = Voigt::Unit(1); ///< xx, yy, xy (2 e_xy) per unit of load
  std::array<bool, 3> free{};       ///< their `direction` must be 0
};

/// The cell with the free strains condensed too: their rows and columns are zero, so that it is used like any
/// other, with the controlled strains alone. The cell itself if nothing is free.
CondensedCell release(const CondensedCell& cell, const std::array<bool, 3>& free);

/// All strains of a cell (of edge 1) whose controlled strains are `strain` and whose openings are `opening`.
Voigt complete_strain(const CondensedCell& cell, const std::array<bool, 3>& free, const Voigt& strain,
                      const Eigen::VectorXd& opening);

} // namespace spall
