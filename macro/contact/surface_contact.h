#pragma once

#include "macro/contact/contact_law.h"
#include "macro/contact/contact_normal.h"
#include "macro/contact/contact_zone.h"
#include "macro/contact/impulses.h"

namespace spall {

/// The law "surface" between deformable bodies. The secondary body of a pair touches with its points, the
/// primary one with its surface, so that the gap between them is that of the continuum and not that of
/// supports. The surface is the known one of a body that stays whole, carried by its points, else a fit
/// through the outermost points. A bar is secondary to its anvil, a slab to the plate behind it and both to
/// the projectile: bodies that break touch with points, bodies that stay whole with a surface. Fragments of
/// one body need no contact of their own: they share the semi-Lagrangian approximation of their body, and
/// repel and slide through it once their kernels overlap.
class SurfaceContact final : public ContactLaw {
public:
  /// Distance from the other bodies up to which points take part, in spacings (ContactZone).
  static constexpr double margin = contact_support;

  SurfaceContact(const ContactInputs& inputs_, const std::vector<ContactPair>& pairs_,
                 const std::vector<ContactBody>& /*bodies*/ = {})
      : inputs(inputs_), pairs(pairs_) {}

  /// Gathers the points near the surfaces, computes the impulses on them, and returns their velocities to the
  /// bodies.
  SolidContactReport apply_impulses(const std::vector<ContactBody>& bodies, double dt, double kick) override;
  /// Impulses of one step for points that would overlap at its end; changes velocities only. The velocities
  /// include the velocity change of the internal force over the time `kick` (s) already; it is subtracted for
  /// the work.
  SolidContactReport touch(const std::vector<ContactBody>& bodies, double dt, double kick);

  /// The gap between the surfaces that face each other at less than a spacing, for any contact law.
  ContactReport measure(const std::vector<ContactBody>& bodies);

  /// Transfers the impulses of the last step, from which the next step's iteration starts.
  void transfer(Archive& archive) override { archive("touches", touches); }

private:
  /// Points of all pairs of bodies whose gap is below `watched` spacings at the end of the step.
  void find_touches(const std::vector<ContactBody>& bodies, double dt, double watched);
  void find_touches(const std::vector<ContactBody>& bodies, const ContactPair& pair, double dt,
                    double watched);
  /// Appends the touches of one pair. Each starts with its impulse of the last step, along the present
  /// normal.
  void append(std::vector<std::vector<Touch>>& parts);
  /// Patch and gap of the touch between the n-th near secondary point and the carried surface of the primary
  /// body. Returns the spacing that the gap is measured by, m: the point's own, or that of the primary body's
  /// nearest point if it is larger; 0 if no surface is near.
  double look_at_carried(Touch& touch, const std::vector<ContactBody>& bodies, std::uint32_t n,
                         double watched) const;
  void book(const Touch& touch, const std::vector<ContactBody>& bodies, double kick,
            SolidContactReport& report) const;

  ContactInputs inputs;
  std::vector<ContactPair> pairs;
  ContactZone zone;
  std::vector<Touch> touches, last; ///< touches of this step and of the previous one
  NearPoints near_secondary, near_primary;
};

} // namespace spall
