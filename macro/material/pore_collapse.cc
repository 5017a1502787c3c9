#include "macro/material/pore_collapse.h"

#include "shared/error.h"

namespace spall {

double PoreCollapse::collapsed(double mu, double alpha) const {
  if (!(alpha > 1 && pressure(mu, alpha) > collapse_pressure(alpha))) return alpha;
  if (pressure(mu, 1) >= P_comp) return 1;
  constexpr double tolerance = 1e-12; // of P_comp
  const auto excess = [&](double a) {
    return ValueAndSlope{pressure(mu, a) - collapse_pressure(a), pressure_slope(mu, a) - collapse_slope(a)};
  };
  return increasing_root(excess, 1, alpha, alpha, tolerance * P_comp);
}

double PoreCollapse::collapsing_modulus(double mu, double alpha) const {
  // P(mu, alpha) = P_c(alpha): dalpha / dmu = -P_mu / (P_alpha - P_c'), dP / dmu = P_c' dalpha / dmu.
  const double slope = -collapse_slope(alpha);
  if (!(alpha > 1)) return modulus(mu, alpha);
  return modulus(mu, alpha) * slope / (slope + pressure_slope(mu, alpha));
}

void PoreCollapse::declare(Parameters::Section& section) {
  const Range positive{above_zero};
  section.quantity(
      "A1", A1, Dimension::stress, positive,
      "pressure of the solid without pores, A1 x + A2 x^2 + A3 x^3, x = density / density without "
      "pressure - 1");
  section.quantity("A2", A2, Dimension::stress, {}, "see A1");
  section.quantity("A3", A3, Dimension::stress, {0}, "see A1");
  section.quantity("T1", T1, Dimension::stress, positive, "pressure of the stretched solid, T1 x");
  section.number("alpha0", alpha0, {1.0001, 10}, "density of the solid over that of the porous material");
  section.quantity("Pel", P_el, Dimension::stress, positive, "pressure where pores begin to collapse");
  section.quantity("Pcomp", P_comp, Dimension::stress, positive, "pressure where none are left");
  section.number("n", n, {1}, "exponent of the collapse");
}

void PoreCollapse::validate(const std::string& file, const std::string& section) const {
  const auto refuse = [&](const std::string& key, double found, const std::string& allowed) {
    throw InputError(file + ": key '" + section + "/" + key + "': found '" +
                     format_quantity(found, Dimension::stress) + "', allowed: " + allowed);
  };
  if (!solid().grows()) refuse("A2", A2, "a pressure A1 x + A2 x^2 + A3 x^3 that always grows with x");
  if (!(P_comp > P_el)) refuse("Pcomp", P_comp, "> Pel");
}

} // namespace spall
