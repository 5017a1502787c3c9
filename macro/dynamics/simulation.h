#pragma once

#include "macro/contact/contact_zone.h"
#include "macro/contact/culvert.h"
#include "macro/contact/kernel_contact.h"
#include "macro/contact/rigid_contact.h"
#include "macro/dynamics/momenta.h"
#include "macro/dynamics/projectile_state.h"
#include "macro/solid/solid.h"
#include "shared/progress.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace spall {

struct TimeInputs {
  double end_time = std::numeric_limits<double>::quiet_NaN(); ///< s
  double step_factor = 0.5;                                   ///< part of h / c
  /// Steps between looks at the run's health (Simulation::verify): estimates of the largest stable step from
  /// the stiffness, which are obeyed, and the detectors; 0: never. A look costs about ten steps.
  int verify_every = 500;
  /// Newmark's constants in the explicit form: u' = u + dt v + dt^2 / 2 a, then a' from u', then v' = v + dt
  /// ((1 - gamma) a + gamma a'). beta > 0 would make a' depend on itself, gamma < 1/2 feeds energy. gamma >
  /// 1/2 damps a vibration of frequency omega at the rate (gamma - 1/2) omega^2 dt / 2 and shortens the
  /// largest stable step by sqrt(2 gamma).
  double beta = 0, gamma = 0.5;
};

/// Energies of the modelled part, J, all at the middle of the last step, where its velocities live.
struct Budget {
  double initial_energy = 0;
  double kinetic = 0;                        ///< of the points
  double body_kinetic = 0;                   ///< of the rigid body, turning included
  StressEnergy internal;                     ///< work of the stresses, stored and dissipated
  double stabilization = 0;                  ///< work of the stress moments
  double friction = 0;                       ///< lost by friction
  double contact = 0;                        ///< lost by normal impulses; work done in overlapping kernels
  double damping = 0;                        ///< lost by time integration with gamma > 1/2
  double culvert = 0;                        ///< of the ring around a slab: kinetic, stored and dissipated
  double initial_momentum = 0, momentum = 0; ///< along z, points and body, N s
  double impulse = 0;                        ///< of the contact on the points so far, along z, N s
  double points_momentum = 0;                ///< of all points, along z, N s
  std::vector<double> solid_momentum;        ///< of each solid, along z, N s

  void transfer(Archive& archive) {
    for (double* part : {&initial_energy, &kinetic, &body_kinetic, &stabilization, &friction, &contact,
                         &damping, &culvert, &initial_momentum, &momentum, &impulse, &points_momentum})
      archive("budget", *part);
    archive("budget_internal", internal);
    archive("budget_solid_momentum", solid_momentum);
  }
  double total() const {
    return kinetic + body_kinetic + internal.total + stabilization + friction + contact + damping + culvert;
  }
  /// Relative to the initial energy (all kinetic).
  double error() const { return initial_energy > 0 ? (total() - initial_energy) / initial_energy : 0; }
};

/// When the projectile's tail has passed a plane, and how fast.
struct Exit {
  double plane = std::numeric_limits<double>::infinity(); ///< z, m
  double time = std::numeric_limits<double>::quiet_NaN(), speed = time;

  bool happened() const { return !std::isnan(time); }
};

/// Where the wall time of the steps has gone, s.
struct PhaseTimes {
  double refresh = 0;  ///< neighbours and shape functions
  double stresses = 0; ///< strains, stresses, internal forces
  double contact = 0;
  double motion = 0; ///< velocities, positions, sums of energy and momentum
};

/// Of points: kinetic energy, J, and momentum along z, N s.
struct Motion {
  double kinetic = 0, momentum = 0;
};

/// State and the step of an explicit run: central differences, velocities at half steps. One time step for
/// all bodies, the smallest any of them needs.
class Simulation {
public:
  /// @param solids_ the deformable bodies, the one the scene is about first: histories and answers speak of
  /// it; then in the order of contact, softest first (BodyContact)
  Simulation(std::vector<std::unique_ptr<Solid>> solids_, RigidBody body_, const ContactInputs& contact_,
             const TimeInputs& time_, const IntegrationInputs& integration_);
  /// One deformable body.
  Simulation(std::unique_ptr<Solid> solid, RigidBody body_, const ContactInputs& contact_,
             const TimeInputs& time_, const IntegrationInputs& integration_);

  /// From t to t + dt. @throws ComputationError with time, place and reason.
  void advance();

  /// Looks at the first solid's detectors and keeps the worst: for every so many steps and for the end of a
  /// run.
  void look_for_defects();

  /// Of linear and angular momentum over the run so far.
  MomentumError momentum_error() const;

  /// All that decides the rest of the run. Loading wants a simulation made from the same inputs.
  void transfer(Archive& archive);
  /// The part of it that is not in the solids, and that is the same on all ranks.
  void transfer_record(Archive& archive);

  /// The solid of that name, or none.
  const Solid* find(const std::string& label) const;

  /// Points of all solids, on all ranks.
  std::size_t point_count() const { return points_of_all; }
  /// Over which the points of the solids are spread. All must make the same calls.
  const Ranks& ranks() const { return solids.front()->ghosts.processes(); }

  std::vector<std::unique_ptr<Solid>> solids;
  RigidBody body;
  ProjectileState projectile;     ///< of a deformable one
  std::optional<Culvert> culvert; ///< around the first solid
  Budget budget;
  PhaseTimes phases;
  double time = 0, step = 0; ///< s; length of the last step
  std::size_t steps = 0, refreshes = 0;
  // Of this process, which may not have begun the run:
  std::size_t own_steps = 0;
  double computing = 0;             ///< processor time of its steps outside MPI, all threads, s
  std::size_t refreshed_points = 0; ///< sum over the refreshes
  std::size_t most_regularized = 0, most_isolated = 0; ///< over the bodies and the run
  double smallest_step_margin =
      std::numeric_limits<double>::infinity(); ///< largest stable step over the step
                                               ///< asked for, over the estimates
  std::size_t step_reductions = 0;             ///< estimates that shortened the steps after them
  HourglassIndicators roughness;               ///< worst of each, over the looks
  double smallest_moment_fraction = 1;         ///< of the bulk's determinant of moments
  double largest_energy_error = 0;             ///< magnitude, relative to the initial energy
  std::vector<std::string> warnings;           ///< each once, in plain words
  double deepest_overlap = 0;                  ///< m, over the run
  double contact_gap_max = 0;                  ///< m, of touching points, over the run
  double mean_contact_gap() const { return gap_count > 0 ? gap_sum / gap_count : 0; } ///< m
  std::vector<Vec3> given_by_first; ///< contact impulse of the first solid on each so far, N s
  std::vector<double> solid_work;   ///< of the stresses in each solid so far, J
  Exit exit;                        ///< of the projectile from the slab
  Vec3 contact_impulse{};           ///< of the first solid on what it touches, in the last step, N s
  /// What this rank asks of all: advance() leaves the largest of all ranks here. Its meaning is the caller's.
  double request = 0;

private:
  /// When a solid's shape functions are to be rebuilt, and the step it allows.
  struct Freshness {
    double stable_step = 0;    ///< s
    double largest_change = 0; ///< of a neighbourhood since the last refresh
    int since_refresh = 0;     ///< steps
  };

  /// What a step has done to one solid.
  struct StepReport {
    ContactReport contact; ///< with the rigid body
    Motion motion;
    SolidReport stresses;
    double damping = 0; ///< energy that gamma > 1/2 has taken, J

    void list(Reduction& of_ranks);
  };

  /// The one message of a step in which all ranks take part. @throws ComputationError what has failed on any
  void put_together(std::vector<StepReport>& reports);
  void warn(bool& said, const std::string& text);
  /// The step factor's part of h / c, or less if the stiffness does not allow it.
  double next_step(double stable_step);
  void refresh_if_needed(Solid& solid, Freshness& freshness);
  /// Velocities of the points from t - dt/2 to t + dt/2 by the internal force and the contact; positions to
  /// t + dt.
  void move(double dt, std::vector<StepReport>& reports, PhaseTimer& timer);
  /// The same of the rigid body: it waits for the impulses of all ranks, and nothing waits for it.
  void move_body(double dt, const std::vector<StepReport>& reports);
  /// Adds the forces to the velocities, after Newmark's gamma has made of them and of the last ones what it
  /// wants.
  void kick(double duration, std::vector<StepReport>& reports);
  /// Impulses of rigid and deformable bodies on each other.
  void touch(double dt, double kick, std::vector<StepReport>& reports);
  template<class Report> void book_contact(const Report& report);
  /// Adds up what the first solid exchanges with the others.
  void count_impulses(const BodyContactReport& report);
  /// Where the projectile is now, and whether it is out.
  void follow_projectile();
  /// Forces of overlapping kernels.
  void add_kernel_forces(double dt);
  /// Books the energies and momenta that belong to the present velocities.
  void book_motion(const std::vector<StepReport>& reports);
  /// Books the work of this step's stresses.
  void book_stresses(const std::vector<StepReport>& reports);

  std::size_t points_of_all = 0;
  Momenta initial_momenta;
  std::vector<Freshness> freshness;
  bool said_strain = false, said_volume = false, said_energy = false, said_step = false;
  ContactInputs contact;
  ContactZone zone;
  BodyContact body_contact;
  KernelContact kernel_contact;
  std::vector<VectorField> last_force;                             ///< of the last step, if gamma > 1/2, N
  double largest_factor = std::numeric_limits<double>::infinity(); ///< of h / c, by the last estimate
  double gap_sum = 0, gap_count = 0; ///< |gap| of touching points over the run, m
  TimeInputs inputs;
  IntegrationInputs integration;
  StressEnergy internal_work;                 ///< to the end of the last step
  double stabilization_work = 0;              ///< the same, J
  double late_contact = 0, late_friction = 0; ///< half of the last step's work of kernels, not yet booked, J
};

} // namespace spall
