#pragma once

#include "macro/dynamics/simulation.h"
#include "shared/summary.h"

namespace spall {

/// What a witness plate has received so far; of the whole plate, SI.
struct WitnessAnswers {
  double momentum = 0;            ///< along z
  double debris_momentum = 0;     ///< brought by the slab's points, along z
  double projectile_momentum = 0; ///< brought by the projectile, along z
  double kinetic_energy = 0;
  double energy = 0; ///< kinetic and work of the stresses
  double largest_plastic_strain = 0;
  double largest_deflection = 0; ///< of a point, along z
};
WitnessAnswers measure_witness(const Simulation& run, std::size_t plate);

/// Adds them if the scene has a plate.
void add_witness(Summary& summary, const Simulation& run);

} // namespace spall
