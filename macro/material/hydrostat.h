#pragma once

#include "shared/input/parameters.h"

namespace spall {

/// How Eq. 21 is read.
enum class HydrostatForm {
  shifted, ///< P = C6 + K1 m + K2 m^2 + K3 m^3, m = mu - C7: continuous at C7
  printed  ///< P = K1 mu + K2 mu^2 + K3 mu^3: drops from 55.1 to 10.6 MPa at C7
};

/// Modulus of unloading and reloading below the largest compression reached.
enum class Unloading {
  interpolated, ///< from the elastic modulus at C7 to C8 at C9 (Holmquist, Johnson and Cook's rule)
  elastic       ///< C6 / C7 up to C9, C8 beyond
};

/// Pressure of concrete against compressive volumetric strain mu (compression positive): elastic, crushing,
/// locked (Eqs. 20 and 21, Fig. 4). Unloading and reloading below the largest mu reached are linear; the
/// paper states only the modulus of the locked state. Names as in Table 1.
struct Hydrostat {
  double C6 = required;                               ///< pressure where crushing begins, Pa
  double C7 = required;                               ///< mu where crushing begins
  double C8 = required;                               ///< locking modulus, Pa
  double C9 = required;                               ///< mu at locking
  double K1 = required, K2 = required, K3 = required; ///< Pa
  HydrostatForm form = HydrostatForm::shifted;
  Unloading unloading = Unloading::interpolated;

  double elastic_modulus() const { return C6 / C7; }

  /// Pressure of first loading, Pa.
  double curve(double mu) const {
    if (mu <= C7) return elastic_modulus() * mu;
    return mu <= C9 ? crushing(mu) : crushing(C9) + C8 * (mu - C9);
  }
  /// Its derivative, Pa.
  double slope(double mu) const {
    if (mu <= C7) return elastic_modulus();
    if (mu > C9) return C8;
    const double m = form == HydrostatForm::shifted ? mu - C7 : mu;
    return K1 + m * (2 * K2 + 3 * K3 * m);
  }
  /// Modulus of unloading and reloading when `largest` is the largest mu ever reached, Pa.
  double unloading_modulus(double largest) const {
    if (largest <= C7) return elastic_modulus();
    if (largest >= C9) return C8;
    if (unloading == Unloading::elastic) return elastic_modulus();
    return elastic_modulus() + (C8 - elastic_modulus()) * (largest - C7) / (C9 - C7);
  }

  struct Response {
    double pressure, modulus; ///< Pa; modulus = dP / dmu of the branch the point is on
  };
  /// Pressure at mu when `largest` is the largest mu ever reached (0 if never compressed). A function of the
  /// two alone, so no error accumulates over steps. Without tension cut-off.
  Response operator()(double mu, double largest) const {
    if (mu >= largest) return {curve(mu), slope(mu)};
    const double modulus = unloading_modulus(largest);
    return {curve(largest) - modulus * (largest - mu), modulus};
  }

  /// Plastic volumetric strain mu_p of Eq. 24, which the paper does not define. Our reading: what stays after
  /// unloading to P = 0.
  double plastic_strain(double largest) const {
    return largest <= C7 ? 0 : largest - curve(largest) / unloading_modulus(largest);
  }

  void declare(Parameters::Section& section);

private:
  double crushing(double mu) const {
    if (form == HydrostatForm::printed) return mu * (K1 + mu * (K2 + mu * K3));
    const double m = mu - C7;
    return C6 + m * (K1 + m * (K2 + m * K3));
  }
};

} // namespace spall
