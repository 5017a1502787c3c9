#include "macro/dynamics/energies.h"

#include "shared/error.h"
#include "shared/input/quantity.h"

#include <cmath>
#include <string>

namespace spall {

void Energies::begin(const StepReport& report, const Bodies& bodies) {
  solid_work.resize(bodies.solids.size());
  book_motion(report, bodies);
  initial = total();
  initial_momentum = momentum;
}

void Energies::book(const StepReport& report, const ContactReport& rigid, const Bodies& bodies, double time) {
  book_contact(report, rigid);
  book_motion(report, bodies);
  book_stresses(report);
  book_kernel_forces(report.kernel_forces);
  check(time);
}

void Energies::book_motion(const StepReport& report, const Bodies& bodies) {
  kinetic = rigid_kinetic = rings = points_momentum = 0;
  solid_momentum.clear();
  for (const SolidStep& solid : report.solids) {
    damping += solid.damping;
    kinetic += solid.motion.kinetic;
    points_momentum += solid.motion.momentum;
    solid_momentum.push_back(solid.motion.momentum);
  }
  bar_kinetic = bar_work = bond_work = 0;
  for (const Reinforcement& bars : bodies.reinforcements) {
    bar_kinetic += bars.kinetic_energy();
    bar_work += bars.steel_work();
    bond_work += bars.bond_work();
    points_momentum += bars.momentum();
  }
  momentum = points_momentum;
  for (const RigidBody& body : bodies.rigids) {
    rigid_kinetic += body.kinetic_energy();
    momentum += body.held() ? 0 : body.mass * body.velocity[2];
  }
  for (const RingStep& ring : report.rings) rings += ring.kinetic + ring.work;
}

void Energies::book_stresses(const StepReport& report) {
  StressEnergy work;
  double moments = 0;
  for (std::size_t s = 0; s < report.solids.size(); ++s) {
    const SolidReport& solid = report.solids[s].stresses;
    work += solid.work;
    solid_work[s] += solid.work.total + solid.stabilization_work;
    moments += solid.stabilization_work;
  }
  // The kinetic energy is that of the middle of the step, where half of the step's work has been done.
  internal = internal_work;
  internal += 0.5 * work;
  stabilization = stabilization_work + 0.5 * moments;
  internal_work += work;
  stabilization_work += moments;
}

void Energies::book_contact(const StepReport& report, const ContactReport& rigid) {
  for (const RingStep& ring : report.rings) contact += ring.contact_loss;
  for (const Reaction& support : report.supports) contact += support.loss;
  const ContactReport& solids = report.contact.between_solids;
  friction += solids.friction_loss, contact += solids.normal_loss;
  friction += rigid.friction_loss, contact += rigid.normal_loss;
  for (const RigidContactReport& pair : report.contact.with_rigid) impulse -= pair.impulse[2];
}

void Energies::book_kernel_forces(const ContactReport& forces) {
  // As with the stresses, half of the work belongs to the velocities of this step, half to the next ones.
  contact += late_contact + 0.5 * forces.normal_loss;
  friction += late_friction + 0.5 * forces.friction_loss;
  late_contact = 0.5 * forces.normal_loss, late_friction = 0.5 * forces.friction_loss;
}

void Energies::check(double time) const {
  if (std::isfinite(total()) && std::isfinite(momentum)) return;
  const auto part = [](const char* name, double value) { return std::string(name) + std::to_string(value); };
  throw ComputationError("t = " + in_six_digits(time * 1e6) + " us: the energy is not finite:" +
                         part(" kinetic ", kinetic + rigid_kinetic) + part(", stresses ", internal.total) +
                         part(", stabilisation ", stabilization) + part(", friction ", friction) +
                         part(", contact ", contact) + part(", rings ", rings) +
                         part(", bars ", bar_kinetic + bar_work + bond_work) + " J");
}

void Energies::transfer(Archive& archive) {
  for (double* part : {&initial, &kinetic, &rigid_kinetic, &stabilization, &friction, &contact, &damping,
                       &rings, &bar_kinetic, &bar_work, &bond_work, &initial_momentum, &momentum, &impulse,
                       &points_momentum, &stabilization_work, &late_contact, &late_friction})
    archive("energies", *part);
  archive("internal_energy", internal);
  archive("internal_work", internal_work);
  archive("solid_momentum", solid_momentum);
  archive("solid_work", solid_work);
}

} // namespace spall
