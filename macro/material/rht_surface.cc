#include "macro/material/rht_surface.h"

#include "shared/error.h"

namespace spall {

void RhtSurface::declare(Parameters::Section& section) {
  const Range positive{above_zero}, not_negative{0}, share{above_zero, 1};
  section.number("A", A, positive, "failure strength over fc: A (P* - F/3 + (A/F)^(-1/N))^N, P* = P / fc");
  section.number("N", N, share, "exponent of the failure strength");
  section.number("fs*", fs, share, "shear strength over fc");
  section.number("ft*", ft, share, "tensile strength over fc");
  section.number("Q0", Q0, {0.51, 1}, "strength in extension over compression (Willam-Warnke) at P = 0");
  section.number("B", B, not_negative, "growth of Q0 with P*");
  section.quantity("Reference rate in compression", rate_c, Dimension::rate, positive, "where F is 1");
  section.quantity("Reference rate in tension", rate_t, Dimension::rate, positive, "where F is 1");
  section.number("beta_c", beta_c, not_negative, "exponent of the rate factor F in compression");
  section.number("beta_t", beta_t, not_negative, "exponent of the rate factor F in tension");
  section.number("gc*", g_c, share, "elastic over failure strength in compression");
  section.number("gt*", g_t, share, "elastic over failure strength in tension");
  section.number("Af", A_f, not_negative, "residual strength over fc: Af P*^Nf");
  section.number("Nf", N_f, positive, "exponent of the residual strength");
}

void RhtSurface::validate(const std::string& file, const std::string& section) const {
  const double Q1 = shear_reduction(), bound = Q0 * fs / Q1;
  if (!(ft < bound))
    throw InputError(file + ": key '" + section + "/ft*': found '" + format_quantity(ft, Dimension::none) +
                     "', allowed: < Q0 fs* / Q1 = " + format_quantity(bound, Dimension::none) +
                     ", or the strength does not fall to zero in tension");
}

} // namespace spall
