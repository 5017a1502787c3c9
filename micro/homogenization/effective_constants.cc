#include "micro/homogenization/effective_constants.h"

#include <cmath>

namespace spall {

// The closest isotropic stiffness is the mean of the stiffness over all rotations in the plane.
EffectiveConstants effective_constants(const VoigtMatrix<2>& C) {
  const double plane_bulk = 0.25 * (C(0, 0) + C(1, 1) + 2 * C(0, 1)); // lambda + mu
  const double mu = 0.125 * (C(0, 0) + C(1, 1) - 2 * C(0, 1) + 4 * C(2, 2));
  const double lambda = plane_bulk - mu;
  VoigtMatrix<2> isotropic;
  isotropic << lambda + 2 * mu, lambda, 0, lambda, lambda + 2 * mu, 0, 0, 0, mu;
  // In the norm of the tensor each coupling with shear counts for 2 components, and C_xyxy for 4.
  const auto norm = [](VoigtMatrix<2> m) {
    m.row(2) *= std::sqrt(2.0);
    m.col(2) *= std::sqrt(2.0);
    return m.norm();
  };
  return {.youngs_modulus = mu * (3 * lambda + 2 * mu) / plane_bulk,
          .poisson_ratio = 0.5 * lambda / plane_bulk,
          .anisotropy = norm(C - isotropic) / norm(isotropic)};
}

} // namespace spall
