#pragma once

#include "macro/contact/contact.h"
#include "macro/dynamics/bodies.h"
#include "macro/dynamics/central_differences.h"
#include "macro/dynamics/energies.h"
#include "macro/dynamics/exchange.h"
#include "macro/dynamics/health.h"
#include "macro/dynamics/momenta.h"
#include "macro/dynamics/step_size.h"
#include "macro/dynamics/time_inputs.h"

#include <memory>
#include <vector>

namespace spall {

/// Where the wall time of the steps has gone, s.
struct PhaseTimes {
  double refresh = 0;  ///< neighbours and shape functions
  double stresses = 0; ///< strains, stresses, internal forces
  double contact = 0;
  double motion = 0; ///< velocities, positions, sums of energy and momentum
};

/// An explicit run: the bodies, the step that moves them, and the books that it keeps. Central differences
/// with velocities at half steps; one time step for all bodies, the smallest any of them needs.
class Simulation {
public:
  /// @throws InputError if the bodies or the contact between them make no sense
  Simulation(Bodies bodies_, const ContactInputs& contact_, const TimeInputs& time_,
             const IntegrationInputs& integration_);

  /// From t to t + dt, or over the steps of a cycle of subcycling, at whose end all points are at the same
  /// time.
  /// @throws ComputationError with time, place and reason, on all ranks.
  void advance();

  /// Looks at the hourglass indicators of all solids and keeps the worst: for the end of a run. Steps do so
  /// by themselves every so many times.
  void look_at_health();

  /// Measures the free energy that the solids hold, and notes whether what they have dissipated has fallen.
  /// All ranks must call it.
  void measure_stored_energy();

  /// Error of linear and angular momentum over the run so far.
  MomentumError momentum_error() const;

  /// Contact impulse of a body on all others in the last step, N s. @throws std::out_of_range
  Vec3 impulse_given_by(const std::string& body) const {
    return Vec3{} - exchange.of_step.received(bodies.index(body)); // no negative zeros
  }

  /// All that decides the rest of the run. Loading needs a simulation made from the same inputs.
  void transfer(Archive& archive);

  /// Points of all solids, on all ranks.
  std::size_t point_count() const { return points_of_all; }
  const Ranks& ranks() const { return bodies.ranks(); }

  Bodies bodies;
  IntegrationInputs integration; ///< of the internal forces of all solids
  Energies energies;
  Health health;
  Exchange exchange;
  PhaseTimes phases;
  double time = 0, step = 0; ///< s; length of the last step
  std::size_t steps = 0;
  double updates = 0; ///< stresses computed so far: one per point and step, or fewer with subcycling
  // Of this process, which may not have begun the run:
  std::size_t own_steps = 0;
  double computing = 0; ///< processor time of its steps outside MPI, all threads, s
  /// What this rank asks of all: advance() leaves the largest of all ranks here. Its meaning is the caller's.
  double request = 0;

private:
  // The equations of a step, in their order.
  double choose_step();
  void advance(double dt);
  void kick(double dt);
  void apply_contact_impulses(double dt);
  void drift(double dt);
  void update_stresses(double dt);
  void reduce();
  void move_rigid_bodies(double dt);
  void add_kernel_forces(double dt);
  void book(double dt);

  /// From the middle of the last step to the middle of one of length dt, s.
  double between_middles(double dt) const { return 0.5 * (step + dt); }
  std::vector<ContactBody> seen_by_contact() const;
  /// Parts that are the same on all ranks and belong to no body.
  void transfer_books(Archive& archive);

  std::size_t points_of_all = 0;
  Momenta initial_momenta;
  StepSize step_size;
  Subcycle subcycle;                           ///< the step under way
  std::vector<CentralDifferences> integrators; ///< of each solid
  Contact contact;
  StepReport report;        ///< of the step under way
  ContactReport with_rigid; ///< its losses and gaps with rigid bodies
};

} // namespace spall
