#include "macro/material/tensile_rate.h"

namespace spall {

void TensileRate::declare(Parameters::Section& section) {
  declare_law(section);
  section.quantity("Compressive strength", compressive_strength, Dimension::stress, {above_zero},
                   "nominal, for the rate laws of Malvar and Crawford and of CEB");
}

void TensileRate::declare_law(Parameters::Section& section) {
  section.choice("Tensile rate law", law,
                 {{"constant", TensileRateLaw::constant},
                  {"Malvar Crawford", TensileRateLaw::malvar_crawford},
                  {"CEB 1990", TensileRateLaw::ceb_1990},
                  {"fib 2010", TensileRateLaw::fib_2010}},
                 "growth of T_max, and of the strain where tensile damage starts, with the strain rate");
  section.number("Tensile rate factor", constant, {above_zero}, "of the constant law");
  section.number(
      "Largest tensile rate factor", largest, {1},
      "at which the laws but the constant one are held: the largest one measured together with the "
      "fracture energy, in a spall bar at 37 1/s");
  section.number("Fracture energy rate exponent", energy_exponent, {0, 1},
                 "fracture energy over the static one is the factor of T_max to this power: 0.24 from spall "
                 "bars; 1: openings of cracks do not depend on the rate");
}

} // namespace spall
