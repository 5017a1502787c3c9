#include "macro/material/hjc.h"

namespace spall {

TrialPressure Hjc::press(State& state, double mu) const {
  const double before = state.largest_compression;
  state.largest_compression = std::max(before, mu);
  const auto [pressure, modulus] = curve(mu, state.largest_compression);
  const double crushed =
      mu > before ? curve.plastic_strain(state.largest_compression) - curve.plastic_strain(before) : 0;
  return {pressure, modulus, crushed};
}

double Hjc::strength(const State& state, double P, double limit, double rate, const Sym3&) const {
  const double cohesion = A * (1 - state.shear_damage), of_rate = rate_factor(rate);
  if (P < 0) return P > -limit ? fc * cohesion * (1 + P / limit) * of_rate : 0;
  return fc * std::min(SFMAX, (cohesion + B * std::pow(P / fc, N)) * of_rate);
}

void Hjc::prepare(const std::vector<double>& spacings) {
  curve.find_lock();
  tension.prepare(spacings, youngs_modulus_of(bulk_modulus(), G), poisson_ratio_of(bulk_modulus(), G), fc);
}

void Hjc::validate(const std::string& file, const std::string& section) const {
  curve.validate(file, section);
  tension.validate(file, section);
}

void Hjc::declare(Parameters& parameters, Needed needed, const std::string& name_of_section) {
  auto section = parameters.section(name_of_section, std::move(needed));
  const Range positive{above_zero}, not_negative{0};
  section.quantity("Density", density, Dimension::density, positive, "of the undeformed material");
  section.quantity("Shear modulus", G, Dimension::stress, positive, "G");
  section.quantity("fc", fc, Dimension::stress, positive,
                   "uniaxial compressive strength: strength and pressure are normalised by it");
  section.number("A", A, not_negative,
                 "cohesion over fc: the strength is (A (1 - D) + B P*^N) (1 + C ln e*)");
  section.number("B", B, not_negative, "growth of the strength with the pressure P* = P / fc");
  section.number("N", N, not_negative, "exponent of P*");
  section.number("C", C, not_negative, "growth of the strength with ln(strain rate / reference rate)");
  section.number("SFMAX", SFMAX, positive, "largest strength over fc");
  section.quantity("Reference rate", reference_rate, Dimension::rate, positive, "where the rate factor is 1");
  section.quantity("Rate floor", rate_floor, Dimension::rate, positive,
                   "smallest strain rate in 1 + C ln(rate / reference rate)");
  section.quantity("T", tension.tensile.T_max, Dimension::stress, positive,
                   "largest mean tension, undamaged");
  section.number("D1", D1, not_negative, "strain to failure D1 (P* + T*)^D2");
  section.number("D2", D2, not_negative, "see D1");
  section.number("EFMIN", EFMIN, positive, "smallest strain to failure");
  curve.declare(section);
  tension.declare(section);
}

} // namespace spall
