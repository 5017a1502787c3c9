#pragma once

#include "micro/cell/aggregates.h"
#include "shared/input/parameters.h"

#include <string>

namespace spall {

/// Section Aggregates of a case.
struct AggregateInputs {
  Grading grading{.smallest = required, .largest = required};
  double youngs_modulus = required, poisson_ratio = required;               ///< of the aggregates
  double mortar_youngs_modulus = required, mortar_poisson_ratio = required; ///< of what is between
  bool scaled = true; ///< both, so that the cell as a whole has the constants of section Material
  double zone_strength = required, zone_energy = required; ///< of the interface zone over those of the mortar
  MortarCracks mortar_cracks = MortarCracks::corners;
  int refinements = 0;

  bool present() const { return grading.fraction > 0; }
  void declare(Parameters& parameters);
  /// In words, for the table and people.
  std::string describe() const;
};

} // namespace spall
