#include "macro/output/witness_answers.h"

#include <algorithm>

namespace spall {

WitnessAnswers measure_witness(const Simulation& run, std::size_t plate) {
  const Solid& solid = *run.bodies.solids[plate];
  const Points& points = solid.points;
  const double copies = solid.ghosts.symmetry().multiplicity();
  WitnessAnswers a;
  for (std::size_t i = 0; i < points.owned; ++i) {
    const Vec3 v = points.velocity[i];
    a.kinetic_energy += 0.5 * copies * points.mass[i] * dot(v, v);
    a.largest_deflection = std::max(a.largest_deflection, points.position.component[2][i] -
                                                              points.initial_position.component[2][i]);
  }
  const Ranks& ranks = solid.ghosts.processes();
  a.kinetic_energy = ranks.sum(a.kinetic_energy);
  a.largest_deflection = ranks.max(a.largest_deflection);
  a.momentum = copies * run.energies.solid_momentum[plate];
  a.debris_momentum = copies * run.exchange.of_run.given(0, plate)[2];
  a.projectile_momentum = a.momentum - a.debris_momentum; // it touches nothing else
  a.energy = a.kinetic_energy + copies * run.energies.solid_work[plate];
  const std::vector<double> strain = solid.field("plastic_strain");
  for (const double one : strain) a.largest_plastic_strain = std::max(a.largest_plastic_strain, one);
  a.largest_plastic_strain = ranks.max(a.largest_plastic_strain);
  return a;
}

void add_witness(Summary& summary, const Simulation& run) {
  for (std::size_t s = 0; s < run.bodies.solids.size(); ++s) {
    if (run.bodies.solids[s]->label != "witness") continue;
    const WitnessAnswers a = measure_witness(run, s);
    summary.set("witness_momentum", a.momentum);
    summary.set("witness_debris_momentum", a.debris_momentum);
    summary.set("witness_projectile_momentum", a.projectile_momentum);
    summary.set("witness_kinetic_energy", a.kinetic_energy);
    summary.set("witness_energy", a.energy);
    summary.set("witness_max_plastic_strain", a.largest_plastic_strain);
    summary.set("witness_max_deflection", a.largest_deflection);
  }
}

} // namespace spall
