#pragma once

namespace spall {

/// Isotropic elasticity in plane strain for Young's modulus 1.
struct PlaneStrain {
  explicit PlaneStrain(double poisson_ratio)
      : lambda(poisson_ratio / ((1 + poisson_ratio) * (1 - 2 * poisson_ratio))),
        mu(0.5 / (1 + poisson_ratio)) {}
  double lambda, mu; ///< Lame's constants over Young's modulus
};

} // namespace spall
