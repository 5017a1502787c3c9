#pragma once

#include "macro/material/increasing_root.h"

#include <cmath>

namespace spall {

/// Pressure k1 x + k2 x^2 + k3 x^3 (Pa) of a material without pores against its compression x = density over
/// that at no pressure - 1; k1 x where it is stretched. Compression positive.
struct CubicPressure {
  double k1, k2, k3; ///< Pa

  /// Whether the pressure grows with every compression.
  bool grows() const { return k1 > 0 && (k3 > 0 ? k2 > 0 || k2 * k2 < 3 * k1 * k3 : k3 == 0 && k2 >= 0); }

  double operator()(double x) const { return x < 0 ? k1 * x : x * (k1 + x * (k2 + x * k3)); }
  double slope(double x) const { return x < 0 ? k1 : k1 + x * (2 * k2 + x * 3 * k3); }
  /// Largest slope between no compression and x.
  double largest_slope(double x) const { return std::fmax(k1, slope(x)); } // the slope is convex (k3 >= 0)

  /// The compression x >= 0 of a pressure >= 0.
  double compression_at(double pressure) const {
    constexpr double tolerance = 1e-14;
    if (!(pressure > 0)) return 0;
    double high = pressure / k1;
    while ((*this)(high) < pressure) high *= 2;
    const auto excess = [&](double x) { return ValueAndSlope{(*this)(x)-pressure, slope(x)}; };
    return increasing_root(excess, 0, high, std::fmin(high, pressure / k1), tolerance * pressure);
  }

  /// Energy per present volume, J/m^3: the integral of pressure dx / (c + x) from 0 to x >= 0, by polynomial
  /// division. c = 1 if x is counted from where the pressure starts; less by what has opened.
  double energy(double x, double c) const {
    const double rest = k1 - c * (k2 - c * k3);
    return x * x * (k3 * x / 3 + (k2 - c * k3) / 2) + rest * (x - c * std::log1p(x / c));
  }
};

/// The same of a linear law K x, K in Pa, x of either sign above -a: K (x - a ln(1 + x / a)), J/m^3.
inline double linear_pressure_energy(double K, double x, double a) { return K * (x - a * std::log1p(x / a)); }

} // namespace spall
