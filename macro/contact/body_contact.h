#pragma once

#include "macro/contact/contact_normal.h"
#include "macro/contact/impulses.h"

namespace spall {

/// What the contact between deformable bodies did in one step.
struct BodyContactReport {
  std::vector<Vec3> impulse;       ///< on each body, N s; they add up to zero (but across symmetry planes)
  std::vector<Vec3> from_first;    ///< the part of it that comes from the first body, N s
  double normal_loss = 0;          ///< energy lost by normal impulses (points are stopped without rebound), J
  double friction_loss = 0;        ///< J
  std::size_t touching = 0;        ///< points that got an impulse
  double deepest = 0;              ///< deepest overlap at the start of the step, m
  double gap_sum = 0, gap_max = 0; ///< |gap| of touching points at the start of the step, m
};

/// Contact between deformable bodies. They are given softest first: of two, the former touches with its
/// points and the latter with its surface, so that the gap between them is that of the continuum and not that
/// of supports. The surface is the known one of a body that stays whole, carried by its points, else a fit
/// through the outermost points. A bar before its anvil, a slab before the plate behind it and both before
/// the projectile: what breaks has points, what stays whole has a surface. Fragments of one body need no
/// contact of their own: they share the semi-Lagrangian approximation of their body, and repel and slide
/// through it once their kernels overlap.
class BodyContact {
public:
  /// How far from the other bodies points have a part in it, in spacings (ContactZone).
  static constexpr double margin = contact_support;

  explicit BodyContact(const ContactInputs& inputs_) : inputs(inputs_) {}

  /// Impulses of one step for points that would overlap at its end; changes velocities only. The velocities
  /// hold the internal force's `kick` (s) already; it is taken off again for the work.
  BodyContactReport apply(const std::vector<ContactBody>& bodies, double dt, double kick);

  /// The gap between the surfaces that face each other at less than a spacing, whatever contact acts there.
  BodyContactReport measure(const std::vector<ContactBody>& bodies);

  /// The impulses of the last step, where the next step's iteration starts.
  void transfer(Archive& archive) { archive("touches", touches); }

private:
  /// Points of all pairs of bodies whose gap is below `watched` spacings at the end of the step.
  void find_touches(const std::vector<ContactBody>& bodies, double dt, double watched);
  void find_touches(const std::vector<ContactBody>& bodies, std::size_t slave, std::size_t master, double dt,
                    double watched);
  /// Patch and gap of the touch between the n-th near slave and the master's surface. Returns the spacing
  /// that the gap is measured by, m: the slave's, or that of the master's nearest point if it is larger; 0 if
  /// no surface is near.
  double look_at_carried(Touch& touch, const std::vector<ContactBody>& bodies, std::uint32_t n,
                         double watched) const;
  double look_at_fitted(Touch& touch, const std::vector<ContactBody>& bodies, std::uint32_t n,
                        double watched) const;

  ContactInputs inputs;
  std::vector<Touch> touches, last; ///< of this step and of the one before
  NearPoints near_slave, near_master;
};

} // namespace spall
