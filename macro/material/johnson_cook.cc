#include "macro/material/johnson_cook.h"

#include "macro/material/increasing_root.h"
#include "shared/error.h"

#include <algorithm>

namespace spall {

JohnsonCook::Flow JohnsonCook::flow(double trial, double at_rest, const State& state, double dt) const {
  const double G = shear_modulus(), soft = 1 - std::pow(homologous(state.heating), m);
  const auto at = [&](double x) -> Flow {
    const double p = state.plastic_strain + x, rate = x / dt;
    const double hardening = B * std::pow(p, n), of_rate = 1 + C * log_rate(rate);
    const double rate_slope = rate > reference_rate ? C / x : 0;
    return {x, (A + hardening) * of_rate * soft,
            soft * (hardening * n / p * of_rate + (A + hardening) * rate_slope)};
  };
  constexpr double tolerance = 1e-11; // of q
  const double without_strength = trial / (3 * G), without_hardening = (trial - at_rest) / (3 * G);
  const auto excess = [&](double x) {
    const Flow flow = at(x);
    return ValueAndSlope{3 * G * x + flow.yield - trial, 3 * G + flow.slope};
  };
  return at(increasing_root(excess, 0, without_strength, without_hardening, tolerance * trial));
}

Stiffness JohnsonCook::update(Sym3& stress, State& state, const StrainStep& step) const {
  const double K = bulk_modulus(), G = shear_modulus();
  const double mean = K * std::log(step.volume_ratio);
  Sym3 s = deviator(stress) + 2 * G * deviator(step.increment);
  const double q = equivalent_stress(s);
  Stiffness tangent{.bulk = K, .shear = G};

  const double at_rest = yield_stress(state.plastic_strain, 0, state.heating);

  if (state.damage < 1 && q > at_rest) {
    const auto [plastic, yield, slope] = flow(q, at_rest, state, step.dt);
    const double rate = plastic / step.dt, return_factor = 1 - 3 * G * plastic / q;
    tangent.direction = std::sqrt(1.5) / q * s; // s / |s|
    tangent.shear = G * return_factor;
    tangent.flow = G * (1 / (1 + slope / (3 * G)) - (1 - return_factor));
    s *= return_factor;
    state.plastic_strain += plastic;
    if (failure) {
      const double triaxiality = yield > 0 ? mean / yield : 0;
      state.damage = std::min(1.0, state.damage + plastic / failure_strain(triaxiality, rate, state.heating));
    }
    state.heating += taylor_quinney * yield * plastic / (density * specific_heat);
  }
  if (state.damage >= 1) {
    stress = plus_spherical(Sym3{}, std::min(0.0, mean));
    return {.bulk = mean < 0 ? K : 0, .limit = 0};
  }
  stress = plus_spherical(s, mean);
  if (failure) tangent.limit = std::max(at_rest, equivalent_stress(s));
  return tangent;
}

void JohnsonCook::validate(const std::string& file, const std::string& section) const {
  if (!(melting_temperature > room_temperature))
    throw InputError(
        file + ": key '" + section + "/Melting temperature': found '" +
        format_quantity(melting_temperature, Dimension::temperature) +
        "', allowed: > Room temperature = " + format_quantity(room_temperature, Dimension::temperature));
}

void JohnsonCook::declare(Parameters& parameters, Needed needed, const std::string& name_of_section) {
  const Needed with_failure = Needed{[this] { return failure; }, "Failure = yes"} && needed;
  auto section = parameters.section(name_of_section, std::move(needed)),
       damage = parameters.section(name_of_section, with_failure);
  const Range positive{above_zero}, not_negative{0};
  section.quantity("Young's modulus", youngs_modulus, Dimension::stress, positive, "E");
  section.number("Poisson's ratio", poisson_ratio, {0, 0.4999}, "nu");
  section.quantity("Density", density, Dimension::density, positive, "of the undeformed material");
  section.quantity("A", A, Dimension::stress, positive,
                   "yield stress at the reference rate and room temperature");
  section.quantity("B", B, Dimension::stress, not_negative, "hardening B p^n; 0: none");
  section.number("n", n, not_negative, "exponent of the plastic strain p");
  section.number("C", C, not_negative,
                 "growth of the strength with ln(plastic strain rate / reference rate)");
  section.number("m", m, positive, "exponent of the homologous temperature T*");
  section.quantity("Reference rate", reference_rate, Dimension::rate, positive,
                   "of plastic strain, where the strength is A + B p^n; below it as well");
  section.quantity("Melting temperature", melting_temperature, Dimension::temperature, positive,
                   "where the strength has fallen to 0 (T* = 1)");
  section.quantity("Room temperature", room_temperature, Dimension::temperature, positive,
                   "where T* = 0; the temperature at the start");
  section.quantity("Specific heat", specific_heat, Dimension::specific_heat, positive, "c, per mass");
  section.number("Taylor-Quinney coefficient", taylor_quinney, {0, 1},
                 "share of the plastic work that heats the point; 0: isothermal");
  section.flag("Failure", failure,
               "whether damage grows with the plastic strain, and a point fails where it reaches 1: it then "
               "carries neither shear nor tension");
  damage.number("D1", D1, {}, "strain to failure (D1 + D2 exp(D3 s*)) (1 + D4 ln e*) (1 + D5 T*)");
  damage.number("D2", D2, {}, "see D1; s* is the mean stress over the yield stress, tension positive");
  damage.number("D3", D3, {}, "see D1; below 0: tension brings failure sooner");
  damage.number("D4", D4, {}, "see D1; e* is the plastic strain rate over the reference rate, at least 1");
  damage.number("D5", D5, {}, "see D1");
  section.number("Least failure strain", least_failure_strain, positive,
                 "the strain to failure is at least this, where its equation gives less or a negative one");
}

} // namespace spall
