#include "micro/aggregate_inputs.h"

namespace spall {

void AggregateInputs::declare(Parameters& parameters) {
  auto section = parameters.section("Aggregates", {[this] { return present(); }, "Volume fraction > 0"});
  section.number(
      "Volume fraction", grading.fraction, {.min = 0, .max = 0.8},
      "volume fraction of the aggregates above the smallest diameter; 0: a cell without aggregates");
  section.quantity(
      "Smallest diameter", grading.smallest, Dimension::length, {.min = above_zero},
      "diameter of the smallest aggregates that are modelled; finer aggregates belong to the mortar");
  section.quantity("Largest diameter", grading.largest, Dimension::length, {.min = above_zero},
                   "largest diameter d_max of the grading curve");
  section.number("Grading exponent", grading.exponent, {.min = 0.1, .max = 1.5},
                 "exponent n of the share (d / d_max)^n that passes a sieve of width d; 0.5: Fuller's curve");
  section.quantity("Young's modulus", youngs_modulus, Dimension::stress, {.min = above_zero},
                   "Young's modulus of the aggregates");
  section.number("Poisson's ratio", poisson_ratio, {.min = 0, .max = 0.49},
                 "Poisson's ratio of the aggregates");
  section.quantity("Mortar Young's modulus", mortar_youngs_modulus, Dimension::stress, {.min = above_zero},
                   "Young's modulus of the mortar");
  section.number("Mortar Poisson's ratio", mortar_poisson_ratio, {.min = 0, .max = 0.49},
                 "Poisson's ratio of the mortar");
  section.flag(
      "Scale to the material", scaled,
      "scales bulk and shear moduli of aggregates and mortar by a factor each, so that the uncracked "
      "cell has the constants of section Material, which the macroscopic model requires of its table; "
      "otherwise the table gets the homogenised constants of the cell");
  section.number("Interface strength", zone_strength, {.min = 0.01, .max = 1},
                 "tensile strength of the interface zone between aggregate and mortar, in units of "
                 "Material/Tensile strength, which is the strength of the mortar");
  section.number(
      "Interface fracture energy", zone_energy, {.min = 0.01, .max = 1},
      "fracture energy of the interface zone, in units of Material/Fracture energy, which is that of "
      "the mortar");
  section.choice("Mortar cracks", mortar_cracks, mortar_crack_words(),
                 "paths along which mortar may crack: corners: from the corners of aggregates; corners and "
                 "flats: also from the middle of their sides; none: the mortar does not crack");
  section.integer("Refinements", refinements, {.min = 0, .max = 4},
                  "number of times that each element is divided into four");
}

std::string AggregateInputs::describe() const {
  const auto number = [](double value) { return format_quantity(value, Dimension::none); };
  const auto length = [](double value) { return format_quantity(value, Dimension::length); };
  return "aggregates of " + length(grading.smallest) + " to " + length(grading.largest) +
         ", volume fraction " + number(grading.fraction) + ", grading exponent " + number(grading.exponent) +
         ", interface zone of " + number(zone_strength) + " of the strength and " + number(zone_energy) +
         " of the fracture energy of the mortar";
}

} // namespace spall
