#pragma once

#include "macro/points/lane_math.h"
#include "shared/input/parameters.h"

#include <type_traits>

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
/// paper states only the modulus of the locked state. Names as in Table 1. V: one point or several
/// (lane_math.h).
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
  template<class V> V curve(const V& mu) const {
    const V locking = C8 * larger(0, V(mu - C9));
    return select(mu <= C7, V(elastic_modulus() * mu), V(crushing(smaller(C9, mu)) + locking));
  }
  /// Its derivative, Pa.
  template<class V> V slope(const V& mu) const {
    const V m = mu - (form == HydrostatForm::shifted ? C7 : 0);
    const V crushing = K1 + m * (2 * K2 + 3 * K3 * m);
    return select(mu <= C7, elastic_modulus(), select(mu > C9, C8, crushing));
  }
  /// Modulus of unloading and reloading when `largest` is the largest mu ever reached, Pa.
  template<class V> V unloading_modulus(const V& largest) const {
    const double elastic = elastic_modulus(), growth = unloading == Unloading::elastic ? 0 : C8 - elastic;
    const V between = elastic + growth * (largest - C7) / (C9 - C7);
    return select(largest <= C7, elastic, select(largest >= C9, C8, between));
  }

  template<class V> struct Response {
    V pressure, modulus; ///< Pa; modulus = dP / dmu of the branch the point is on
  };
  /// Pressure at mu when `largest` is the largest mu ever reached (0 if never compressed). A function of the
  /// two alone, so no error accumulates over steps. Without tension cut-off.
  template<class V> Response<V> operator()(const V& mu, const std::type_identity_t<V>& largest) const {
    const auto first = mu >= largest; // loading
    const V modulus = unloading_modulus(largest), pressure = curve(larger(largest, mu));
    return {select(first, pressure, V(pressure - modulus * (largest - mu))),
            select(first, slope(mu), modulus)};
  }

  /// Plastic volumetric strain mu_p of Eq. 24, which the paper does not define. Our reading: what stays after
  /// unloading to P = 0.
  template<class V> V plastic_strain(const V& largest) const {
    return select(largest <= C7, 0, V(largest - curve(largest) / unloading_modulus(largest)));
  }

  void declare(Parameters::Section& section);

private:
  template<class V> V crushing(const V& mu) const {
    const bool printed = form == HydrostatForm::printed;
    const V m = mu - (printed ? 0 : C7);
    return (printed ? 0 : C6) + m * (K1 + m * (K2 + m * K3));
  }
};

} // namespace spall
