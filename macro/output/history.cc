#include "macro/output/history.h"

#include "shared/error.h"
#include "shared/input/quantity.h"

#include <cmath>
#include <initializer_list>

namespace spall {

double centre_of_mass(const Points& points) {
  double mass = 0, moment = 0;
  for (std::size_t i = 0; i < points.owned; ++i) {
    mass += points.mass[i];
    moment += points.mass[i] * points.position.component[2][i];
  }
  return moment / mass;
}

History::History(const std::filesystem::path& directory) : stream(directory / "history.csv") {
  stream << "time,projectile_position,projectile_velocity,contact_force,kinetic_energy,internal_energy,"
            "stabilization_energy,friction_work,contact_work,damping_work,projectile_kinetic_energy,total_"
            "energy,energy_"
            "error,"
            "momentum,impulse,time_step\n";
}

void History::write(const Simulation& run) {
  if (run.steps == last_step) return;
  last_step = run.steps;
  const Points& points = run.solids[0]->points;
  const Budget& b = run.budget;
  const double copies = run.solids[0]->ghosts.symmetry().multiplicity();
  double position = run.body.position[2], velocity = run.body.velocity[2];
  if (std::isinf(run.body.mass)) {
    double mass = 0;
    for (std::size_t i = 0; i < points.owned; ++i) mass += points.mass[i];
    position = centre_of_mass(points);
    velocity = b.solid_momentum[0] / mass;
  }
  const double force = run.step > 0 ? run.contact_impulse[2] / run.step : 0;
  bool first = true;
  for (const double value :
       {run.time, position, velocity, copies * force, copies * b.kinetic, copies * b.internal,
        copies * b.stabilization, copies * b.friction, copies * b.contact, copies * b.damping,
        copies * b.body_kinetic, copies * b.total(), b.error(), copies * b.points_momentum,
        copies * b.impulse, run.step}) {
    stream << (first ? "" : ",") << format_quantity(value, Dimension::none);
    first = false;
  }
  stream << "\n" << std::flush;
  if (!stream) throw ComputationError("history.csv cannot be written: disk full?");
}

} // namespace spall
