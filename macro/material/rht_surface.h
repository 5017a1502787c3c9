#pragma once

#include "macro/material/failure_surface.h"
#include "shared/input/parameters.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace spall {

/// Strength of concrete after Riedel, Hiermaier and Thoma, with the equations of Borrvall and Riedel (8th
/// European LS-DYNA Users Conference, 2011). All stresses over fc, pressure P* compression positive:
///
///   failure     f = A (P* - F/3 + (A/F)^(-1/N))^N                     3 P* >= F
///               f = F fs/Q1 + 3 P* (1 - fs/Q1)                   F >  3 P* >= 0
///               f = F fs/Q1 - 3 P* (1/Q2 - fs/(Q1 ft)), at least 0    0 > P*
///   Lode        R3(theta, Q): Willam-Warnke, Q = Q0 + B P* within 0.51 and 1
///   rate        F = (rate / reference)^beta, at least 1, of compression for 3 P* >= F_c, of tension for
///               3 P* <= -F_t ft, linear between
///   elastic     f reduced by g_c for 3 P* >= F_c g_c, by g_t for 3 P* <= -F_t g_t ft, linear between, and
///               closed by a cap where pores collapse
///   residual    A_f P*^N_f
///
/// Q1 = R3(30 degrees, Q0) and Q2 = Q0 are held at their values for P* = 0, so that the straight pieces are
/// straight and meet. theta is 0 in triaxial extension.
struct RhtSurface {
  double A = required, N = required;           ///< 1
  double fs = required, ft = required;         ///< shear and tensile strength over fc
  double Q0 = required, B = required;          ///< 1
  double rate_c = 3e-5, rate_t = 3e-6;         ///< reference rates, 1/s
  double beta_c = required, beta_t = required; ///< 1
  double g_c = required, g_t = required;       ///< elastic over failure strength
  double A_f = required, N_f = required;       ///< 1

  /// F of a strain rate (1/s).
  double compressive_rate(double rate) const { return std::pow(std::max(1., rate / rate_c), beta_c); }
  double tensile_rate(double rate) const { return std::pow(std::max(1., rate / rate_t), beta_t); }
  double rate_factor(double P, double rate) const {
    const double c = compressive_rate(rate), t = tensile_rate(rate);
    return between(3 * P, -t * ft, t, c, c);
  }
  /// f, the compression meridian.
  double failure(double P, double F) const {
    const double Q1 = shear_reduction();
    if (3 * P >= F) return A * std::pow(P - F / 3 + std::pow(A / F, -1 / N), N);
    if (P >= 0) return F * fs / Q1 + 3 * P * (1 - fs / Q1);
    return std::max(0., F * fs / Q1 - 3 * P * (1 / Q0 - fs / (Q1 * ft)));
  }
  /// -P* where f falls to 0 in tension, at a rate.
  double tension_limit(double rate) const {
    const double Q1 = shear_reduction();
    return tensile_rate(rate) * Q0 * fs * ft / (3 * (Q0 * fs - Q1 * ft));
  }
  /// f R3 along a deviator: the failure strength at a rate.
  double failure(double P, double rate, const Sym3& s) const {
    return failure(P, rate_factor(P, rate)) *
           FailureSurface::lode_reduction<double>(s, std::clamp(Q0 + B * std::max(0., P), 0.51, 1.));
  }
  /// Share of the failure strength where flow starts, without the cap.
  double elastic_share(double P, double rate) const {
    return between(3 * P, -tensile_rate(rate) * g_t * ft, g_t, compressive_rate(rate) * g_c, g_c);
  }
  /// Factor of the cap: 1 up to P_u, 0 at P_c and above.
  static double cap(double P, double P_u, double P_c) {
    if (P <= P_u) return 1;
    if (P >= P_c) return 0;
    const double beyond = (P - P_u) / (P_c - P_u);
    return std::sqrt(1 - beyond * beyond);
  }
  double residual(double P) const { return A_f * std::pow(std::max(0., P), N_f); }

  void declare(Parameters::Section& section);
  /// @throws InputError: strengths that do not meet in tension
  void validate(const std::string& file, const std::string& section) const;

private:
  /// Q1: R3 in pure shear.
  double shear_reduction() const {
    return FailureSurface::lode_reduction<double>(Sym3{0, 0, 0, 1, 0, 0}, Q0);
  }
  /// low_value up to low, high_value from high on, linear between.
  static double between(double x, double low, double low_value, double high, double high_value) {
    const double share = std::clamp((x - low) / (high - low), 0., 1.);
    return low_value + share * (high_value - low_value);
  }
};

} // namespace spall
