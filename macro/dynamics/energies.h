#pragma once

#include "macro/dynamics/bodies.h"
#include "macro/dynamics/step_report.h"

#include <vector>

namespace spall {

/// Energies, J, and momenta along z, N s, of the modelled part, all at the middle of the last step, where its
/// velocities live.
struct Energies {
  double initial = 0;       ///< all kinetic
  double kinetic = 0;       ///< of the points
  double rigid_kinetic = 0; ///< of the rigid bodies, turning included
  StressEnergy internal;    ///< work of the stresses, stored and dissipated
  StressEnergy stored; ///< free energy of the solids at the last look (Simulation::measure_stored_energy)
  double stabilization = 0; ///< work of the stress moments
  double friction = 0;      ///< lost by friction
  double contact = 0; ///< lost by normal impulses, at supports and in bonds; work done in overlapping kernels
  double damping = 0; ///< lost by time integration with gamma > 1/2
  double rings = 0;   ///< of elastic rings: kinetic, stored and dissipated
  double bar_kinetic = 0, bar_work = 0; ///< of reinforcing bars; work: stored and dissipated in the steel
  double bond_work = 0;                 ///< stored and dissipated between bars and concrete

  double initial_momentum = 0, momentum = 0; ///< of points and free rigid bodies
  double impulse = 0;                        ///< of the rigid bodies on the points so far
  double points_momentum = 0;                ///< of all points, and of the bars in them
  std::vector<double> solid_momentum;        ///< of each solid
  std::vector<double> solid_work;            ///< of the stresses in each solid so far, J

  double total() const {
    return kinetic + rigid_kinetic + internal.total + stabilization + friction + contact + damping + rings +
           bar_kinetic + bar_work + bond_work;
  }
  /// What the materials have dissipated by the last look at the stored energy.
  double dissipated() const { return internal.total + stabilization - stored.total; }
  /// Relative to the initial energy; 0 if there was none.
  double error() const { return initial > 0 ? (total() - initial) / initial : 0; }

  /// The start of a run, from the velocities that the bodies have.
  void begin(const StepReport& report, const Bodies& bodies);
  /// One step, once all ranks have put it together and the rigid bodies have moved.
  /// @param rigid losses of the contact with rigid bodies
  /// @throws ComputationError with time and parts if the sum is not finite
  void book(const StepReport& report, const ContactReport& rigid, const Bodies& bodies, double time);
  void transfer(Archive& archive);

private:
  void book_motion(const StepReport& report, const Bodies& bodies);
  void book_stresses(const StepReport& report);
  void book_contact(const StepReport& report, const ContactReport& rigid);
  void book_kernel_forces(const ContactReport& forces);
  /// @throws ComputationError
  void check(double time) const;

  StressEnergy internal_work;                 ///< to the end of the last step
  double stabilization_work = 0;              ///< the same, J
  double late_contact = 0, late_friction = 0; ///< half of the last step's work of kernels, not yet booked, J
};

} // namespace spall
