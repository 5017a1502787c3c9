#pragma once

#include "micro/equilibrium/condensed_cell.h"

#include <array>

namespace spall {

/// Macroscopic loading: the strain grows along `direction`; a `free` component of strain takes the value at
/// which its stress vanishes.
template<int dim> struct MacroLoad {
  Voigt<dim> direction = Voigt<dim>::Unit(1); ///< strain per unit of load
  /// Components of strain whose stress vanishes; `direction` must be 0 there.
  std::array<bool, voigt_size<dim>> free{};
};

/// Condenses the free strain components out as well. Their rows and columns become zero, so that the result
/// is used like any other cell, with the controlled strains alone. Without free components the result equals
/// the cell.
template<int dim>
CondensedCell<dim> release(const CondensedCell<dim>& cell, const std::array<bool, voigt_size<dim>>& free);

/// Returns all strain components of a cell (of edge 1) from the controlled ones and the openings.
template<int dim>
Voigt<dim> complete_strain(const CondensedCell<dim>& cell, const std::array<bool, voigt_size<dim>>& free,
                           const Voigt<dim>& strain, const Eigen::VectorXd& opening);

} // namespace spall
