#include "macro/material/rht.h"

namespace spall {

TrialPressure Rht::press(State& state, double mu) const {
  const double before = alpha(state), now = pores.collapsed(mu, before);
  state.collapse = pores.alpha0 - now;
  state.solid_compression = std::max(state.solid_compression, pores.compression_of_solid(mu, now));
  return {pores.pressure(mu, now), now < before ? pores.collapsing_modulus(mu, now) : pores.modulus(mu, now),
          pores.plastic_strain(now) - pores.plastic_strain(before)};
}

double Rht::reached(const State& state, double P, double rate) const {
  constexpr double least = 1e-6; // P / g must stay finite where the cap closes; f g is then nearly 0
  // The cap starts where plastic flow has moved it to, and ends where pores collapse.
  const double P_u = surface.compressive_rate(rate) * surface.g_c / 3 + xi * G / fc * state.plastic_strain;
  const double elastic = surface.elastic_share(P / fc, rate) *
                         RhtSurface::cap(P / fc, P_u, pores.collapse_pressure(alpha(state)) / fc);
  return std::max(least, state.hardening + (1 - state.hardening) * elastic);
}

double Rht::strength(const State& state, double P, double limit, double rate, const Sym3& s) const {
  const double D = state.shear_damage;
  if (P < 0 && !tension.own()) return P > -limit ? strength(state, 0, limit, rate, s) * (1 + P / limit) : 0;
  const double g = reached(state, P, rate);
  return fc * ((1 - D) * g * surface.failure(P / fc / g, rate, s) + D * surface.residual(P / fc));
}

void Rht::harm(State& state, double plastic, double, double P, double rate, const Sym3& s) const {
  if (!(plastic > 0)) return;
  if (state.hardening < 1) {
    const double e_h = hardening_strain(P, rate, s);
    state.hardening = e_h > plastic ? std::min(1., state.hardening + plastic / e_h) : 1;
    return;
  }
  const double D = state.shear_damage;
  state.shear_damage = std::min(1., D + plastic / failure_strain(P, D, rate));
}

void Rht::prepare(const std::vector<double>& spacings) {
  tension.tensile.T_max = fc * surface.tension_limit(0);
  tension.prepare(spacings, youngs_modulus_of(bulk_modulus(), G), poisson_ratio_of(bulk_modulus(), G), fc);
}

void Rht::validate(const std::string& file, const std::string& section) const {
  pores.validate(file, section);
  surface.validate(file, section);
  tension.validate(file, section);
}

void Rht::declare(Parameters& parameters, Needed needed, const std::string& name_of_section) {
  auto section = parameters.section(name_of_section, std::move(needed));
  const Range positive{above_zero}, not_negative{0};
  section.quantity("Density", density, Dimension::density, positive, "of the undeformed, porous material");
  section.quantity("Shear modulus", G, Dimension::stress, positive, "G");
  section.quantity("fc", fc, Dimension::stress, positive,
                   "uniaxial compressive strength: strength and pressure are normalised by it");
  surface.declare(section);
  section.number("xi", xi, {above_zero, 1}, "share of the shear modulus in the strain of hardening");
  section.number("D1", D1, not_negative, "strain to failure D1 (P* + (1 - D) Pt*)^D2");
  section.number("D2", D2, not_negative, "see D1");
  section.number("EPM", EPM, positive, "smallest strain to failure");
  pores.declare(section);
  tension.declare(section);
}

} // namespace spall
