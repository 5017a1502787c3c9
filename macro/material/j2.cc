#include "macro/material/j2.h"

namespace spall {

void J2::declare(Parameters& parameters, Needed needed, const std::string& name_of_section) {
  auto section = parameters.section(name_of_section, std::move(needed));
  section.quantity("Young's modulus", youngs_modulus, Dimension::stress, {above_zero}, "E");
  section.number("Poisson's ratio", poisson_ratio, {0, 0.4999}, "nu");
  section.quantity("Yield stress", initial_yield, Dimension::stress, {above_zero},
                   "von Mises stress at which plastic flow starts");
  section.quantity("Hardening modulus", hardening_modulus, Dimension::stress, {0},
                   "slope of the yield stress against plastic strain; 0: perfectly plastic");
  section.quantity("Density", density, Dimension::density, {above_zero}, "of the undeformed material");
}

} // namespace spall
