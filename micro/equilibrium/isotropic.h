#pragma once

namespace spall {

/// Isotropic elasticity for 3D and plane strain, in units of a reference Young's modulus.
struct Isotropic {
  explicit Isotropic(double poisson_ratio, double youngs_modulus = 1)
      : lambda(youngs_modulus * poisson_ratio / ((1 + poisson_ratio) * (1 - 2 * poisson_ratio))),
        mu(0.5 * youngs_modulus / (1 + poisson_ratio)) {}
  /// Returns the stress of a strain tensor; in 2D for plane strain.
  template<class Tensor> Tensor stress(const Tensor& strain) const {
    Tensor result = 2 * mu * strain;
    const double isotropic = lambda * trace(strain);
    for (unsigned int i = 0; i < Tensor::dimension; ++i) result[i][i] += isotropic;
    return result;
  }
  double lambda, mu; ///< Lame's constants
};

} // namespace spall
