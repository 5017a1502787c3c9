#pragma once

#include "micro/equilibrium/condensed_cell.h"

#include <array>

namespace spall {

/// Macroscopic loading: the strain grows along `direction`; a `free` component of strain takes the value at
/// which its stress vanishes.
template<int dim> struct MacroLoad {
  Voigt<dim> direction = Voigt<dim>::Unit(1); ///< per unit of load
  std::array<bool, voigt_size<dim>> free{};   ///< `direction` must be 0 in these components
};

/// The cell with the free strains condensed too: their rows and columns are zero, so that it is used like any
/// other, with the controlled strains alone. The cell itself if nothing is free.
template<int dim>
CondensedCell<dim> release(const CondensedCell<dim>& cell, const std::array<bool, voigt_size<dim>>& free);

/// All strains of a cell (of edge 1) whose controlled strains are `strain` and whose openings are `opening`.
template<int dim>
Voigt<dim> complete_strain(const CondensedCell<dim>& cell, const std::array<bool, voigt_size<dim>>& free,
                           const Voigt<dim>& strain, const Eigen::VectorXd& opening);

} // namespace spall
