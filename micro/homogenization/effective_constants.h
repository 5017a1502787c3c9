#pragma once

#include "micro/equilibrium/condensed_cell.h"

namespace spall {

/// Isotropic constants of plane strain that come nearest to a stiffness.
struct EffectiveConstants {
  double youngs_modulus = 0, poisson_ratio = 0;
  double anisotropy = 0; ///< norm of what the isotropic stiffness misses over its own, of the tensors
};

/// @param stiffness of a cell in plane strain; the modulus comes in its units
EffectiveConstants effective_constants(const VoigtMatrix<2>& stiffness);

} // namespace spall
