#include "macro/dynamics/simulation.h"

#include "shared/progress.h"
#include "shared/traffic.h"

#include <cstdint>

namespace spall {
namespace {

/// Adds the wall time of a scope to its phase, and its processor time outside MPI to all computing, s.
class Timed {
public:
  Timed(double& phase_, double& computing_)
      : phase(phase_), computing(computing_), begin(processor_seconds() - seconds_in_mpi()) {}
  ~Timed() {
    watch.split(phase);
    computing += processor_seconds() - seconds_in_mpi() - begin;
  }
  Timed(const Timed&) = delete;
  Timed& operator=(const Timed&) = delete;

private:
  double &phase, &computing;
  double begin;
  PhaseTimer watch;
};

Bodies checked(Bodies bodies) {
  bodies.validate();
  return bodies;
}

} // namespace

Simulation::Simulation(Bodies bodies_, const ContactInputs& contact_, const TimeInputs& time_,
                       const IntegrationInputs& integration_)
    : bodies(checked(std::move(bodies_))), integration(integration_),
      step_size(time_, integration, bodies.solids.size()),
      integrators(bodies.solids.size(), CentralDifferences(time_.gamma)),
      contact(contact_, seen_by_contact(), bodies.solid_names(), bodies.rigid_names()) {
  subcycle.steps = time_.subcycles;
  for (const auto& solid : bodies.solids) points_of_all += solid->points.owned;
  points_of_all = static_cast<std::size_t>(ranks().sum(static_cast<double>(points_of_all)));
  exchange.of_step = exchange.of_run = ImpulseMatrix(bodies.count());
  health.hourglass.resize(bodies.solids.size());
  report.solids.resize(bodies.solids.size());
  report.rings.resize(bodies.rings.size());
  report.supports.resize(bodies.supports.size());
  const TrafficOf use(MpiUse::setup);
  for (std::size_t s = 0; s < bodies.solids.size(); ++s)
    report.solids[s].motion = motion_sums(bodies.solids[s]->points);
  report.reduce(ranks(), request);
  energies.begin(report, bodies);
  initial_momenta = momenta_of(bodies);
}

void Simulation::advance() {
  const double dt = choose_step(); // neighbours and shape functions (Eqs. 6-8), stable step
  for (subcycle.step = 0; subcycle.step < subcycle.steps; ++subcycle.step) advance(dt);
}

void Simulation::advance(double dt) {
  kick(dt);                   // v += f / m
  apply_contact_impulses(dt); // Eqs. 13-16
  drift(dt);                  // x += v dt
  update_stresses(dt);        // objective stress update; f = Eq. 11
  reduce();                   // the one message of a step; all ranks stop together
  move_rigid_bodies(dt);      // by the impulses of all points
  add_kernel_forces(dt);      // Eq. 12
  book(dt);                   // energies, momenta, exchange; a number that is none stops the run
}

double Simulation::choose_step() {
  const Timed timed(phases.refresh, computing);
  const auto [smallest, unit] = step_size.refresh(bodies, health, time);
  subcycle.stable_step = smallest;
  double dt = step_size.choose(unit, bodies, health, time, steps);
  for (const Reinforcement& bars : bodies.reinforcements) dt = bars.stable_step(dt);
  return dt;
}

void Simulation::kick(double dt) {
  const Timed timed(phases.motion, computing);
  for (std::size_t k = 0; k < bodies.supports.size(); ++k) {
    const HeldPoints& support = bodies.supports[k];
    report.supports[k] = support.take_forces(bodies.solids[support.solid]->points, between_middles(dt));
  }
  for (std::size_t s = 0; s < bodies.solids.size(); ++s)
    report.solids[s].damping = integrators[s].kick(bodies.solids[s]->points, between_middles(dt));
  for (Reinforcement& bars : bodies.reinforcements) bars.kick(between_middles(dt));
}

void Simulation::apply_contact_impulses(double dt) {
  const Timed timed(phases.contact, computing);
  for (std::size_t r = 0; r < bodies.rings.size(); ++r) {
    ElasticRing& ring = bodies.rings[r];
    report.rings[r].contact_loss = ring.apply(bodies.solids[ring.solid]->points, dt, between_middles(dt));
  }
  std::vector<BarNodes> bars;
  for (Reinforcement& one : bodies.reinforcements) bars.push_back({one.solid, &one.nodes()});
  report.contact = contact.apply_impulses(seen_by_contact(), bodies.rigids, dt, between_middles(dt), bars);
  for (std::size_t k = 0; k < bodies.supports.size(); ++k) {
    const HeldPoints& support = bodies.supports[k];
    support.stop(bodies.solids[support.solid]->points, report.supports[k]);
  }
}

void Simulation::drift(double dt) {
  const Timed timed(phases.motion, computing);
  for (std::size_t s = 0; s < bodies.solids.size(); ++s) {
    CentralDifferences::drift(bodies.solids[s]->points, dt);
    report.solids[s].motion = motion_sums(bodies.solids[s]->points);
  }
  for (Reinforcement& bars : bodies.reinforcements) bars.drift(dt);
  for (std::size_t r = 0; r < bodies.rings.size(); ++r) {
    bodies.rings[r].move(dt);
    report.rings[r].kinetic = bodies.rings[r].kinetic_energy();
    report.rings[r].work = bodies.rings[r].work();
  }
}

void Simulation::update_stresses(double dt) {
  const Timed timed(phases.stresses, computing);
  for (std::size_t s = 0; s < bodies.solids.size(); ++s)
    report.solids[s].stresses = bodies.solids[s]->update(dt, time + dt, subcycle);
  for (Reinforcement& bars : bodies.reinforcements) bars.update(bodies.solids[bars.solid]->points, dt);
}

void Simulation::reduce() {
  const Timed timed(phases.motion, computing);
  report.reduce(ranks(), request);
  step_size.observe(report);
}

void Simulation::move_rigid_bodies(double dt) {
  const Timed timed(phases.motion, computing);
  with_rigid = contact.push_rigid(report.contact, bodies.rigids);
  for (RigidBody& body : bodies.rigids) body.move(dt);
}

void Simulation::add_kernel_forces(double dt) {
  const Timed timed(phases.contact, computing);
  report.kernel_forces = contact.add_forces(seen_by_contact(), dt);
}

void Simulation::book(double dt) {
  const Timed timed(phases.motion, computing);
  time += dt;
  step = dt;
  ++steps, ++own_steps;
  exchange.of_step = ImpulseMatrix(bodies.count());
  contact.count(report.contact, exchange.of_step);
  exchange.of_step.add(report.kernel_forces.exchange);
  exchange.of_run.add(exchange.of_step);
  exchange.count(report.contact.between_solids);
  exchange.count(with_rigid);
  exchange.count(report.kernel_forces);
  exchange.count(report.supports);
  energies.book(report, with_rigid, bodies, time);
  for (const SolidStep& solid : report.solids) updates += solid.stresses.updates;
  // Within a cycle blocks are at different times.
  if (subcycle.ends(subcycle.steps)) health.note_energy_error(energies.error(), time);
}

void Simulation::look_at_health() {
  if (steps > 0) health.look(bodies, time);
}

void Simulation::measure_stored_energy() {
  energies.stored = {};
  for (const auto& solid : bodies.solids) energies.stored += solid->elastic_energy();
  health.note_dissipated(energies.dissipated(), energies.initial, time);
}

MomentumError Simulation::momentum_error() const {
  Momenta expected = initial_momenta;
  expected.linear += exchange.reaction_of_run.impulse;
  expected.angular += exchange.reaction_of_run.angular;
  return compare(expected, momenta_of(bodies), bodies.symmetry());
}

std::vector<ContactBody> Simulation::seen_by_contact() const {
  std::vector<ContactBody> seen;
  for (const auto& solid : bodies.solids)
    seen.push_back({&solid->points, &solid->ghosts, solid->bulk_modulus(), solid->shear_modulus(),
                    solid->surface ? &*solid->surface : nullptr});
  return seen;
}

void Simulation::transfer(Archive& archive) {
  bodies.transfer(archive);
  transfer_books(archive);
  for (std::size_t s = 0; s < bodies.solids.size(); ++s)
    integrators[s].transfer(archive, bodies.solids[s]->label, bodies.solids[s]->points.owned,
                            bodies.solids[s]->block_size);
}

void Simulation::transfer_books(Archive& archive) {
  archive("time", time);
  archive("step", step);
  archive("steps", steps);
  archive("updates", updates);
  archive("phases", phases);
  archive("initial_momenta", initial_momenta);
  energies.transfer(archive);
  health.transfer(archive);
  exchange.transfer(archive);
  step_size.transfer(archive);
  contact.transfer(archive);
}

} // namespace spall
