#include "micro/aggregate_inputs.h"

namespace spall {

void AggregateInputs::declare(Parameters& parameters) {
  auto some = parameters.section("Aggregates", [this] { return present(); });
  some.number("Volume fraction", grading.fraction, {.min = 0, .max = 0.8},
              "of aggregates above the smallest diameter; 0: a cell without aggregates");
  some.quantity("Smallest diameter", grading.smallest, Dimension::length, {.min = above_zero},
                "that is modelled; finer aggregates belong to the mortar");
  some.quantity("Largest diameter", grading.largest, Dimension::length, {.min = above_zero},
                "of the grading curve");
  some.number("Grading exponent", grading.exponent, {.min = 0.1, .max = 1.5},
              "n of the share (d / d_max)^n that passes a sieve d; 0.5: Fuller");
  some.quantity("Young's modulus", youngs_modulus, Dimension::stress, {.min = above_zero},
                "of the aggregates");
  some.number("Poisson's ratio", poisson_ratio, {.min = 0, .max = 0.49}, "of the aggregates");
  some.quantity("Mortar Young's modulus", mortar_youngs_modulus, Dimension::stress, {.min = above_zero},
                "of the mortar");
  some.number("Mortar Poisson's ratio", mortar_poisson_ratio, {.min = 0, .max = 0.49}, "of the mortar");
  some.flag("Scale to the material", scaled,
            "scales bulk and shear moduli of aggregates and mortar by a factor each, so that the uncracked "
            "cell has the constants of section Material, as the macroscopic model demands of its table; "
            "otherwise the table gets the constants that the cell has");
  some.number("Interface strength", zone_strength, {.min = 0.01, .max = 1},
              "of the zone between aggregate and mortar, in units of Material/Tensile strength, which is the "
              "mortar's");
  some.number("Interface fracture energy", zone_energy, {.min = 0.01, .max = 1},
              "of that zone, in units of Material/Fracture energy, which is the mortar's");
  some.choice("Mortar cracks", mortar_cracks, mortar_crack_words(),
              "where mortar may crack: from the corners of aggregates, also from the middle of their sides, "
              "or nowhere");
  some.integer("Refinements", refinements, {.min = 0, .max = 4}, "times each element is split into four");
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
