#pragma once

#include "macro/material/concrete_step.h"
#include "macro/material/material_law.h"
#include "macro/material/pore_collapse.h"
#include "macro/material/rht_surface.h"

#include <array>
#include <cmath>

namespace spall {

/// Concrete of Riedel, Hiermaier and Thoma, with the equations of Borrvall and Riedel (8th European LS-DYNA
/// Users Conference, 2011). SI units, tension positive, pressures and mu compression positive; P* = P / fc.
///
///   pressure   PoreCollapse
///   strength   S / fc = (1 - D) g f(P* / g) R3 + D A_f P*^N_f                          (RhtSurface)
///              g = h + (1 - h) g_elastic cap, h the hardening from 0 to 1
///   hardening  dh = dp / e_h,   e_h = fc f R3 (1 - g_elastic) / (3 xi G)
///   damage     dD = dp / e_f once h = 1,   e_f = max(EPM, D1 (P* + (1 - D) P_t*)^D2)
///   tension    mean stress at most limit = (1 - D) P_t, where f falls to 0, or that of a damage table
///              (ConcreteTension), towards which the strength at P = 0 then falls linearly
///
/// p is the equivalent plastic strain. Readings of ours: the hardening strain is that of the failure surface
/// and is counted per step; the strain rate is the equivalent deviatoric one of the step.
struct Rht {
  static constexpr const char* name = "RHT";
  static constexpr bool ductile = false;

  double density = required;                           ///< of the porous material, kg/m^3
  double G = required;                                 ///< shear modulus, Pa
  double fc = required;                                ///< compressive strength, Pa
  double xi = required;                                ///< share of G in hardening
  double D1 = required, D2 = required, EPM = required; ///< 1
  RhtSurface surface;
  PoreCollapse pores;
  ConcreteTension tension;

  struct State : ConcreteState {
    double collapse = 0;          ///< alpha0 - alpha: pores that have gone
    double solid_compression = 0; ///< largest compression of the solid so far
    double hardening = 0;         ///< h
  };
  /// History variables by name, for output.
  static constexpr std::array<HistoryField<State>, 6> fields = {
      {{"pore_collapse", &State::collapse, "1"},
       {"hardening", &State::hardening, "1"},
       {"shear_damage", &State::shear_damage, "1"},
       {"tensile_damage", &State::tensile_damage, "1"},
       {"tensile_strain", &State::tensile_strain, "1"},
       {"plastic_strain", &State::plastic_strain, "1"}}};

  double bulk_modulus() const { return pores.elastic_modulus(); } ///< of the undamaged material, Pa
  double shear_modulus() const { return G; }
  double alpha(const State& state) const { return pores.alpha0 - state.collapse; }
  /// dP / dmu of the stiffest branch the point can be on, Pa.
  double stiffest_modulus(const State& state) const {
    return std::max(pores.T1, pores.solid().largest_slope(state.solid_compression)) / pores.alpha0;
  }
  /// Longitudinal wave speed of that branch, m/s: for the time step.
  double sound_speed(const State& state) const {
    return std::sqrt((stiffest_modulus(state) + 4. / 3 * G) / density);
  }
  /// Elastic moduli of that branch.
  Stiffness elastic(const State& state) const {
    return {.bulk = (1 + state.solid_compression) * pores.alpha0 / alpha(state) * stiffest_modulus(state),
            .shear = G};
  }
  /// Free energy: what the solid, tension and shear give back. The collapse of pores is not.
  StoredEnergy stored_energy(const Sym3& stress, const State& state) const {
    const double P = -trace(stress) / 3, a = alpha(state);
    return {P < 0 ? tension_energy(P, state, pores.touching_modulus(), pores.plastic_strain(a))
                  : pores.stored_energy(P, a, state.opened),
            shape_energy(stress, state, G)};
  }

  /// e_f at a pressure, Pa, a damage and a rate, 1/s.
  double failure_strain(double P, double damage, double rate) const {
    const double base = P / fc + (1 - damage) * surface.tension_limit(rate);
    return std::max(EPM, D1 * std::pow(std::max(0., base), D2));
  }
  /// e_h at a pressure, Pa, and a rate, 1/s, along a deviator.
  double hardening_strain(double P, double rate, const Sym3& s) const {
    return fc * surface.failure(P / fc, rate, s) * (1 - surface.elastic_share(P / fc, rate)) / (3 * xi * G);
  }

  // For ConcreteStep, which says what they are.
  TrialPressure press(State& state, double mu) const;
  double tension_limit(const State& state, double rate) const {
    return fc * surface.tension_limit(rate) * (1 - state.shear_damage);
  }
  double strength(const State& state, double P, double limit, double rate, const Sym3& s) const;
  void harm(State& state, double plastic, double, double P, double rate, const Sym3& s) const;

  /// Advances the (already rotated) Cauchy stress and the state by one step (ConcreteStep).
  Stiffness update(Sym3& stress, State& state, const StrainStep& step) const {
    return ConcreteStep<Rht>(*this, stress, state, step).finish(stress);
  }

  /// Binds the keys of a section. `needed`: whether the constants must be set (default: always).
  void declare(Parameters& parameters, Needed needed = {}, const std::string& section = name);
  /// Checks what no single key can. @throws InputError, which names `file` and the key in `section`
  void validate(const std::string& file, const std::string& section = name) const;
  /// Makes the curves of the damage table for points of these spacings (m). Its static limit is P_t.
  /// @throws InputError: the damage table is unreadable or not for this material in tension
  void prepare(const std::vector<double>& spacings);
  bool softens() const { return true; } ///< D takes the cohesion
  bool needs_spacing() const { return tension.needs_spacing(); }
  double strength_limit() const { return std::numeric_limits<double>::infinity(); } ///< grows with pressure
  Description describe() const { return {{"damage_table", tension.table()}}; }

private:
  /// g, the share of the failure surface that hardening has reached.
  double reached(const State& state, double P, double rate) const;
};

} // namespace spall
