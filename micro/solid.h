#pragma once

#include "micro/equilibrium/bulk.h"
#include "micro/inputs.h"

#include <memory>

namespace spall {

/// The elastic solid of a case at one cell size, with its homogenised constants. Without aggregates it is the
/// same for all sizes.
template<int dim> struct Solid {
  std::unique_ptr<const Bulk<dim>> bulk;
  double youngs_modulus = 0, poisson_ratio = 0; ///< homogenised constants of the uncracked cell: Pa, 1
  double anisotropy = 0;                        ///< anisotropy of the uncracked cell, see EffectiveConstants
};

/// @throws ComputationError if aggregates cannot be placed or scaled
template<int dim> Solid<dim> make_solid(const MicrocellInputs& inputs, double cell_size);

/// Returns the elasticity of mortar and aggregate, indexed by material number, scaled so that the uncracked
/// cell as a whole has Young's modulus 1 and Poisson's ratio `poisson_ratio` (isotropic part): one factor for
/// the shear moduli of both, one for their plane bulk moduli lambda + mu.
/// @param phases unscaled elasticity of mortar and aggregate, in any unit
/// @throws std::runtime_error if no such factors are found
std::vector<Isotropic> scaled_phases(const CellComplex<2>& complex, const Elements& elements,
                                     unsigned int refinements, std::vector<Isotropic> phases,
                                     double poisson_ratio);

} // namespace spall
