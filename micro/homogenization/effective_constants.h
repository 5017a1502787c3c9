#pragma once

#include "micro/equilibrium/condensed_cell.h"

namespace spall {

/// Plane strain constants of the isotropic stiffness that is closest to a given one.
struct EffectiveConstants {
  double youngs_modulus = 0, poisson_ratio = 0;
  /// Norm of the difference between the stiffness tensors over the norm of the isotropic one.
  double anisotropy = 0;
};

/// @param stiffness stiffness of a cell in plane strain; the returned modulus has its units
EffectiveConstants effective_constants(const VoigtMatrix<2>& stiffness);

} // namespace spall
