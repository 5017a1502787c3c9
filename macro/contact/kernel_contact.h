#pragma once

#include "macro/contact/surface_contact.h"

namespace spall {

/// The law "kernel" between deformable bodies: forces where the kernels of two bodies overlap (paper Eqs.
/// 12-16), as in the natural kernel contact of Guan et al. (2011) and Chi et al. (2015).
///
/// At a point J whose support holds points of another body the gradients B of the shape functions are those
/// of the joint cloud. The solid has already summed the forces of J's own cloud, so the contact adds what the
/// other body changes: B(joint) - B(own), which vanishes for a joint rigid motion and sums to zero over the
/// cloud, so that momentum is kept. The contact stress at J is a traction on the plane with normal n. It
/// grows elastically with the part of the strain that the other body causes, must not pull (n . sigma . n <
/// 0), and its tangential part is returned to Coulomb's cone (Eqs. 13-16).
/// Points begin to interact at the distance of a support, so that bodies come to rest with a gap of about a
/// spacing between their surfaces.
class KernelContact final : public ContactLaw {
public:
  /// Distance from the other bodies up to which points take part, in spacings (ContactZone): the cloud of a
  /// point that interacts with the other body extends one support farther.
  static constexpr double margin = 2 * contact_support * largest_cell_stretch;

  KernelContact(const ContactInputs& inputs_, const std::vector<ContactPair>& pairs_,
                const std::vector<ContactBody>& /*bodies*/ = {})
      : inputs(inputs_), pairs(pairs_), surfaces(inputs_, pairs_) {}

  /// Gathers the points near the other bodies, adds the forces on them, returns these to the bodies, and
  /// measures the gap between the surfaces. The losses include the energy that the contact stores.
  SolidContactReport add_forces(const std::vector<ContactBody>& bodies, double dt) override;
  void transfer(Archive& archive) override { archive("contact_traction", remembered); }

private:
  struct Force {
    std::uint32_t index; ///< index in the arrays of its body, images included
    bool own;            ///< whether the point belongs to the body of J
    Vec3 value;          ///< force, N
  };
  struct Result {
    std::vector<Force> forces;
    double normal_work = 0, friction_work = 0;
    bool touching = false;
  };
  void add_forces_at(const std::vector<ContactBody>& bodies, std::size_t own, std::size_t other, double dt,
                     SolidContactReport& report);

  /// The contact traction of a point, which is stored from step to step.
  struct Traction {
    std::uint64_t number; ///< number of the point
    Vec3 value;           ///< Pa
  };
  /// Returns the tractions of the present points; zero where there was no contact.
  static std::vector<Vec3> recall(const std::vector<Traction>& kept, const ContactBody& body);
  static std::vector<Traction> keep(const std::vector<Vec3>& tractions, const ContactBody& body);

  ContactInputs inputs;
  std::vector<ContactPair> pairs;
  ContactZone zone;
  SurfaceContact surfaces; ///< measures the gap
  /// Tractions by body and other body, with ascending numbers.
  std::vector<std::vector<std::vector<Traction>>> remembered;
  NearPoints near_own, near_other;
};

} // namespace spall
