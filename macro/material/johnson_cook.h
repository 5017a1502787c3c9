#pragma once

#include "macro/material/material_law.h"

#include <array>
#include <cmath>
#include <limits>

namespace spall {

/// Metal: the strength of Johnson and Cook (1983), heated by its own plastic flow, and their failure (Eng.
/// Fract. Mech. 21, 1985). SI units, tension positive. p is the equivalent plastic strain, e* the plastic
/// strain rate over the reference rate, T* = (T - T_room) / (T_melt - T_room) within 0 and 1:
///
///   yield stress     Y = (A + B p^n) (1 + C ln e*) (1 - T*^m)
///   heating          rho c dT = taylor_quinney Y dp                       (adiabatic)
///   damage           dD = dp / e_f,   e_f = (D1 + D2 exp(D3 s*)) (1 + D4 ln e*) (1 + D5 T*)
///
/// s* is the mean stress over Y. At rates below the reference rate ln e* is held at 0, where it would fall
/// without bound, and s* is held at 1.5, above which the authors do not use the equation. D does not reduce
/// Y: a point whose D reaches 1 has failed, and carries from then on neither shear nor tension.
///
/// Elasticity is linear in ln J: mean stress K ln J; no equation of state with temperature. A failed point
/// therefore carries pressure again when it is as dense as at the start.
struct JohnsonCook {
  static constexpr const char* name = "Johnson-Cook";
  static constexpr bool ductile = true;
  /// Largest s* of the equation of e_f (Johnson and Cook 1985).
  static constexpr double largest_triaxiality = 1.5;

  double youngs_modulus = required;      ///< Pa
  double poisson_ratio = required;       ///< 1
  double density = required;             ///< kg/m^3
  double A = required, B = required;     ///< Pa
  double n = required, C = required;     ///< 1
  double m = required;                   ///< 1
  double reference_rate = 1;             ///< 1/s
  double melting_temperature = required; ///< K
  double room_temperature = 298;         ///< of T* = 0, and at the start, K
  double specific_heat = required;       ///< J/(kg K)
  double taylor_quinney = 0.9;           ///< share of the plastic work that heats; 0: isothermal
  bool failure = false;
  double D1 = required, D2 = required, D3 = required, D4 = required, D5 = required; ///< 1
  double least_failure_strain = 1e-6; ///< e_f where its equation falls below

  struct State {
    double plastic_strain = 0; ///< p
    double heating = 0;        ///< T - T_room, K
    double damage = 0;         ///< D; 1: failed
  };
  /// History variables by name, for output.
  static constexpr std::array<HistoryField<State>, 3> fields = {
      {{"plastic_strain", &State::plastic_strain, "1"},
       {"heating", &State::heating, "K"},
       {"damage", &State::damage, "1"}}};

  double bulk_modulus() const { return youngs_modulus / (3 * (1 - 2 * poisson_ratio)); }
  double shear_modulus() const { return youngs_modulus / (2 * (1 + poisson_ratio)); }
  /// Longitudinal wave speed, m/s: for the time step.
  double sound_speed(const State&) const {
    return std::sqrt((bulk_modulus() + 4. / 3 * shear_modulus()) / density);
  }
  /// Elastic moduli, of a sound point.
  Stiffness elastic(const State&) const { return {.bulk = bulk_modulus(), .shear = shear_modulus()}; }
  /// Free energy: mean^2 / 2 K + s : s / 4 G. Heat, and what hardening stores, are not given back.
  StoredEnergy stored_energy(const Sym3& stress, const State&) const {
    const Sym3 s = deviator(stress);
    const double mean = trace(stress) / 3;
    return {mean * mean / (2 * bulk_modulus()), contract(s, s) / (4 * shear_modulus())};
  }

  /// T* of a heating T - T_room (K), within 0 and 1.
  double homologous(double heating) const {
    return std::clamp(heating / (melting_temperature - room_temperature), 0.0, 1.0);
  }
  /// ln e* of a plastic strain rate (1/s), at least 0.
  double log_rate(double rate) const { return std::log(std::max(1.0, rate / reference_rate)); }
  /// Y, Pa. @param plastic_strain p  @param rate of plastic strain, 1/s  @param heating T - T_room, K
  double yield_stress(double plastic_strain, double rate, double heating) const {
    return (A + B * std::pow(plastic_strain, n)) * (1 + C * log_rate(rate)) *
           (1 - std::pow(homologous(heating), m));
  }
  /// e_f. @param triaxiality s*, mean stress over Y; the others as of yield_stress
  double failure_strain(double triaxiality, double rate, double heating) const {
    const double s = std::min(largest_triaxiality, triaxiality);
    const double e_f =
        (D1 + D2 * std::exp(D3 * s)) * (1 + D4 * log_rate(rate)) * (1 + D5 * homologous(heating));
    return std::max(least_failure_strain, e_f);
  }

  /// Advances the (already rotated) Cauchy stress and the state by one step. The plastic strain of the step
  /// and its rate are those that keep the stress on the yield surface at the end of the step; the temperature
  /// is that of its start. Returns the consistent tangent at that temperature; of a failed point the bulk
  /// modulus under pressure alone. Where points can fail, their stress moments are held below the strength.
  Stiffness update(Sym3& stress, State& state, const StrainStep& step) const;

  /// Binds the keys of a section. `needed`: whether the constants must be set (default: always).
  void declare(Parameters& parameters, Needed needed = {}, const std::string& section = name);
  /// Checks what no single key can. @throws InputError, which names `file` and the key in `section`
  void validate(const std::string& file, const std::string& section = name) const;
  void prepare(const std::vector<double>&) {} ///< the same at any spacing
  bool softens() const { return failure; }    ///< the slow softening by heat alone does not count
  bool needs_spacing() const { return false; }
  /// Largest stress difference, Pa: without bound if it grows with strain or rate.
  double strength_limit() const { return B > 0 || C > 0 ? std::numeric_limits<double>::infinity() : A; }
  Description describe() const { return {}; }

private:
  struct Flow {
    double plastic; ///< plastic strain of the step
    double yield;   ///< Y at its end, Pa
    double slope;   ///< dY / d plastic of the step, with its rate, Pa
  };
  /// The plastic strain x of a step with 3 G x + Y(p + x, x / dt, T) = q.
  /// @param trial q, the equivalent stress without flow, Pa  @param at_rest Y of the state at rest, below q,
  /// Pa
  Flow flow(double trial, double at_rest, const State& state, double dt) const;
};

} // namespace spall
