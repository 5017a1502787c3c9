#pragma once

#include "macro/material/cubic_pressure.h"
#include "shared/input/parameters.h"

namespace spall {

/// Pressure of concrete after Holmquist, Johnson and Cook (1993) against mu = density over initial density -
/// 1: elastic, crushing, dense. SI units, compression positive.
///
///   elastic    P = K_e mu,  K_e = P_crush / mu_crush,                     up to (mu_crush, P_crush)
///   crushing   a straight line to (mu_L, P_lock); unloading and reloading along a line whose slope grows
///   with
///              the largest mu so far, from K_e at mu_crush to K_L at mu_L
///   dense      P = K1 m + K2 m^2 + K3 m^3,  m = (mu - mu_lock) / (1 + mu_lock), loading and unloading
///
/// mu_lock is what remains of a locked point without pressure. Locking itself is at mu_L, where the dense
/// curve has P_lock, so that the pressure does not jump; and K_L is the slope from (mu_lock, 0) to
/// (mu_L, P_lock), so that what remains does not jump either. The authors take K1 for it, 12 % more for their
/// concrete.
struct CrushCurve {
  double P_crush = required;                          ///< Pa
  double mu_crush = required;                         ///< 1
  double P_lock = required;                           ///< Pa
  double mu_lock = required;                          ///< 1
  double K1 = required, K2 = required, K3 = required; ///< Pa

  CubicPressure dense() const { return {K1, K2, K3}; }
  double elastic_modulus() const { return P_crush / mu_crush; } ///< K_e, Pa
  /// Finds mu_L. Call it when the constants are known, before all below.
  void find_lock() { lock = mu_lock + (1 + mu_lock) * dense().compression_at(P_lock); }
  double mu_L() const { return lock; }
  double locked_modulus() const { return P_lock / (lock - mu_lock); } ///< K_L, Pa
  double crushing_modulus() const { return (P_lock - P_crush) / (lock - mu_crush); }
  double dense_compression(double mu) const { return (mu - mu_lock) / (1 + mu_lock); } ///< m

  /// Slope of unloading and reloading when `largest` is the largest mu ever reached, below mu_L, Pa.
  double unloading_modulus(double largest) const {
    const double K_e = elastic_modulus();
    if (largest <= mu_crush) return K_e;
    return K_e + (locked_modulus() - K_e) * (largest - mu_crush) / (lock - mu_crush);
  }
  bool locked(double largest) const { return largest >= lock; }
  /// Slope where the pressure is zero: of unloading, and of tension, Pa.
  double touching_modulus(double largest) const {
    return locked(largest) ? K1 / (1 + mu_lock) : unloading_modulus(largest);
  }
  /// Largest dP / dmu up to the largest mu so far, Pa.
  double stiffest_modulus(double largest) const {
    return locked(largest) ? dense().largest_slope(dense_compression(largest)) / (1 + mu_lock)
                           : unloading_modulus(largest);
  }
  /// Volumetric strain that remains without pressure, mu_p.
  double plastic_strain(double largest) const {
    if (largest <= mu_crush) return 0;
    return locked(largest) ? mu_lock : largest - first_loading(largest) / unloading_modulus(largest);
  }

  struct Response {
    double pressure, modulus; ///< Pa; modulus = dP / dmu
  };
  /// Pressure at mu when `largest` is the largest mu ever reached (at least mu), without tension cut-off.
  Response operator()(double mu, double largest) const {
    if (locked(largest)) {
      const double m = dense_compression(mu);
      return {dense()(m), dense().slope(m) / (1 + mu_lock)};
    }
    const double modulus = unloading_modulus(largest);
    if (mu < largest) return {first_loading(largest) - modulus * (largest - mu), modulus};
    return {first_loading(mu), mu <= mu_crush ? elastic_modulus() : crushing_modulus()};
  }
  /// Energy that a pressure >= 0 gives back, J/m^3. @param opened part of mu that has opened and stays
  double stored_energy(double pressure, double largest, double opened) const {
    if (locked(largest)) return dense().energy(dense().compression_at(pressure), 1 - opened / (1 + mu_lock));
    const double K = unloading_modulus(largest);
    return linear_pressure_energy(K, pressure / K, 1 + plastic_strain(largest) - opened);
  }

  void declare(Parameters::Section& section);
  /// @throws InputError: constants with which the pressure falls, or gives back more than it has taken
  void validate(const std::string& file, const std::string& section) const;

private:
  /// Elastic and crushing, up to mu_L, Pa.
  double first_loading(double mu) const {
    return mu <= mu_crush ? elastic_modulus() * mu : P_crush + crushing_modulus() * (mu - mu_crush);
  }
  double lock = required;
};

} // namespace spall
