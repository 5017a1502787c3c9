#pragma once

#include "macro/material/cubic_pressure.h"
#include "shared/input/parameters.h"

#include <algorithm>
#include <cmath>

namespace spall {

/// Pressure of a porous solid: the p-alpha law of Herrmann (1969), as in RHT. SI units, compression positive.
/// alpha >= 1 is the density of the solid over that of the porous material, alpha0 at the start; x is the
/// compression of the solid, mu the density over the initial density - 1:
///
///   solid        p_s = A1 x + A2 x^2 + A3 x^3 (T1 x where it is stretched),  x = alpha (1 + mu) / alpha0 - 1
///   porous       P = p_s / alpha
///   collapse     alpha falls so that P is at most
///                P_c = P_comp - (P_comp - P_el) ((alpha - 1) / (alpha0 - 1))^(1 / n)
///
/// Unloading and reloading keep alpha. The part of the pressure that grows with the heat of the solid is left
/// out: without it, what is dissipated never comes back.
struct PoreCollapse {
  double A1 = required, A2 = required, A3 = required; ///< Hugoniot of the solid, Pa
  double T1 = required;                               ///< of the stretched solid, Pa
  double alpha0 = required;                           ///< 1
  double P_el = required, P_comp = required;          ///< where collapse begins and ends, Pa
  double n = required;                                ///< 1

  CubicPressure solid() const { return {A1, A2, A3}; }
  double elastic_modulus() const { return A1 / alpha0; } ///< dP / dmu at the start, Pa
  double compression_of_solid(double mu, double alpha) const { return alpha * (1 + mu) / alpha0 - 1; }
  /// mu that remains without pressure.
  double plastic_strain(double alpha) const { return alpha0 / alpha - 1; }
  /// P at which pores of this alpha collapse, Pa.
  double collapse_pressure(double alpha) const {
    return P_comp - (P_comp - P_el) * std::pow(pores_left(alpha), 1 / n);
  }
  /// P at mu without collapse, Pa.
  double pressure(double mu, double alpha) const {
    const double x = compression_of_solid(mu, alpha);
    return (x < 0 ? T1 * x : solid()(x)) / alpha;
  }
  /// dP / dmu without collapse, Pa.
  double modulus(double mu, double alpha) const {
    const double x = compression_of_solid(mu, alpha);
    return (x < 0 ? T1 : solid().slope(x)) / alpha0;
  }
  /// dP / dmu where P = 0, of tension, Pa.
  double touching_modulus() const { return T1 / alpha0; }

  /// The alpha after collapse at mu, if it was `alpha` before.
  double collapsed(double mu, double alpha) const;
  /// dP / dmu while pores collapse, Pa.
  double collapsing_modulus(double mu, double alpha) const;
  /// Energy that a pressure >= 0 gives back, J/m^3. @param opened part of mu that has opened and stays
  double stored_energy(double pressure, double alpha, double opened) const {
    const double x = solid().compression_at(alpha * pressure);
    return solid().energy(x, 1 - opened * alpha / alpha0) / alpha;
  }

  void declare(Parameters::Section& section);
  /// @throws InputError: constants with which the pressure falls
  void validate(const std::string& file, const std::string& section) const;

private:
  double pores_left(double alpha) const { return std::max(0., (alpha - 1) / (alpha0 - 1)); }
  /// d P_c / d alpha, below 0, Pa.
  double collapse_slope(double alpha) const {
    return -(P_comp - P_el) / (n * (alpha0 - 1)) * std::pow(pores_left(alpha), 1 / n - 1);
  }
  /// dP / d alpha at mu, Pa.
  double pressure_slope(double mu, double alpha) const {
    return (modulus(mu, alpha) * (1 + mu) - pressure(mu, alpha)) / alpha;
  }
};

} // namespace spall
