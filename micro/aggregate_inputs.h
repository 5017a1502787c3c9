#pragma once

#include "micro/cell/aggregates.h"
#include "shared/input/parameters.h"

#include <string>

namespace spall {

/// The input section Aggregates of a case file: grading, elasticity and interface zone of a cell made of
/// aggregates in mortar.
struct AggregateInputs {
  Grading grading{.smallest = required, .largest = required};
  double youngs_modulus = required, poisson_ratio = required; ///< elastic constants of the aggregates: Pa, 1
  /// Elastic constants of the mortar between the aggregates: Pa, 1.
  double mortar_youngs_modulus = required, mortar_poisson_ratio = required;
  bool scaled = true; ///< scales the elasticity of both phases so that the cell as a whole has the constants
                      ///< of section Material
  double zone_strength = required, zone_energy = required; ///< strength and fracture energy of the interface
                                                           ///< zone, each divided by the mortar's value
  MortarCracks mortar_cracks = MortarCracks::corners;
  int refinements = 0;

  bool present() const { return grading.fraction > 0; }
  void declare(Parameters& parameters);
  /// Returns a one-line description for the damage table and for printed reports.
  std::string describe() const;
};

} // namespace spall
