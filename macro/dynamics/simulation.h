#pragma once

#include "macro/contact/rigid_contact.h"
#include "macro/dynamics/solid.h"

#include <memory>

namespace spall {

struct TimeInputs {
  double end_time = std::numeric_limits<double>::quiet_NaN(); ///< s
  double step_factor = 0.5;                                   ///< part of h / c
};

/// Energies of the modelled part, J, all at the middle of the last step, where its velocities live.
struct Budget {
  double initial_energy = 0;
  double kinetic = 0;                        ///< of the points
  double body_kinetic = 0;                   ///< of the rigid body
  double internal = 0;                       ///< work of the stresses, stored and dissipated
  double stabilization = 0;                  ///< work of the stress moments
  double friction = 0;                       ///< lost by friction
  double contact = 0;                        ///< lost by normal impulses
  double initial_momentum = 0, momentum = 0; ///< along z, points and body, N s
  double impulse = 0;                        ///< of the contact on the points so far, along z, N s
  double points_momentum = 0;                ///< along z, N s

  double total() const { return kinetic + body_kinetic + internal + stabilization + friction + contact; }
  /// Relative to the initial energy (all kinetic).
  double error() const { return initial_energy > 0 ? (total() - initial_energy) / initial_energy : 0; }
};

/// State and the step of an explicit run: central differences, velocities at half steps.
class Simulation {
public:
  Simulation(std::unique_ptr<Solid> solid_, RigidBody body_, const ContactInputs& contact_,
             const TimeInputs& time_, const IntegrationInputs& integration_);

  /// From t to t + dt. @throws ComputationError with time, place and reason.
  void advance();

  std::unique_ptr<Solid> solid;
  RigidBody body;
  Budget budget;
  double time = 0, step = 0; ///< s; length of the last step
  std::size_t steps = 0, refreshes = 0;
  RefreshReport last_refresh; ///< counts of the last one
  std::size_t most_regularized = 0, most_isolated = 0;
  double deepest_overlap = 0; ///< m, over the run
  Vec3 contact_impulse{};     ///< on the body in the last step, N s

private:
  void refresh_if_needed();
  /// Velocities from t - dt/2 to t + dt/2 by the internal force and the contact; positions to t + dt.
  void move(double dt);
  /// Books the work of this step's stresses.
  void account(const SolidReport& report);

  ContactInputs contact;
  TimeInputs inputs;
  IntegrationInputs integration;
  double internal_work = 0, stabilization_work = 0; ///< to the end of the last step, J
  double largest_change = 0;
  int since_refresh = 0;
};

} // namespace spall
