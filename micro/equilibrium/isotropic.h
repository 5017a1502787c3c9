#pragma once

namespace spall {

/// Isotropic elasticity, in 3D or plane strain alike, in units of a Young's modulus of reference.
struct Isotropic {
  explicit Isotropic(double poisson_ratio, double youngs_modulus = 1)
      : lambda(youngs_modulus * poisson_ratio / ((1 + poisson_ratio) * (1 - 2 * poisson_ratio))),
        mu(0.5 * youngs_modulus / (1 + poisson_ratio)) {}
  /// Stress of a symmetric tensor of strain; in 2D that of plane strain.
  template<class Tensor> Tensor stress(const Tensor& strain) const {
    Tensor result = 2 * mu * strain;
    const double isotropic = lambda * trace(strain);
    for (unsigned int i = 0; i < Tensor::dimension; ++i) result[i][i] += isotropic;
    return result;
  }
  double lambda, mu; ///< Lame's constants
};

} // namespace spall
