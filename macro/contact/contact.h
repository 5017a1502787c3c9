#pragma once

#include "macro/contact/contact_law.h"
#include "macro/contact/rigid_contact.h"

#include <memory>
#include <string>
#include <vector>

namespace spall {

/// Results of the contact in one step, by kind.
struct ContactStep {
  /// Reports of all pairs of a solid and a rigid body; of this rank until they are reduced.
  std::vector<RigidContactReport> with_rigid;
  SolidContactReport between_solids; ///< report of the contact between solids, equal on all ranks

  void list(Reduction& of_ranks) {
    for (RigidContactReport& report : with_rigid) report.list(of_ranks);
  }
};

/// The nodes of reinforcing bars in a solid.
struct BarNodes {
  std::size_t solid; ///< its number
  Points* nodes;
};

/// The interface of the folder contact: it knows which bodies act on each other, and by which law.
///
/// Every deformable body touches every rigid one with its points (law "points": frictional point contact,
/// rigid_contact.h). Every two deformable bodies follow the law of the inputs, or are bonded. Rigid bodies do
/// not touch each other: they pass through one another.
class Contact {
public:
  /// Bodies are numbered as they come: solids first, then rigid bodies.
  /// @param solids the deformable bodies in the order of contact, softest first: of two, the former is the
  /// secondary one
  /// @param solid_names, rigid_names by which inputs.bonded names bodies, and messages
  /// @throws InputError for a bond of bodies that are not there, not deformable or do not touch
  Contact(const ContactInputs& inputs, const std::vector<ContactBody>& solids,
          const std::vector<std::string>& solid_names, const std::vector<std::string>& rigid_names);

  const std::vector<ContactPair>& pairs() const { return list; }

  /// Impulses of one step, before the points move: first of the rigid bodies on the solids, then of the
  /// solids on each other. Changes velocities of points only: rigid bodies get theirs by push_rigid().
  /// @param bars lists of nodes of reinforcing bars, each of one solid; the nodes are the same on all ranks.
  /// They touch rigid bodies only, as points do, and their impulses are counted as those of the solid
  ContactStep apply_impulses(const std::vector<ContactBody>& solids, const std::vector<RigidBody>& rigids,
                             double dt, double kick, const std::vector<BarNodes>& bars = {});
  /// The rigid bodies' side of the impulses, once they are added up over the ranks. @return losses and gaps
  /// of the step, of all solids and rigid bodies together
  ContactReport push_rigid(const ContactStep& step, std::vector<RigidBody>& rigids) const;
  /// Forces of one step, at its end.
  SolidContactReport add_forces(const std::vector<ContactBody>& solids, double dt);

  /// Adds to `exchange` what solids and rigid bodies have given to each other.
  void count(const ContactStep& step, ImpulseMatrix& exchange) const;

  void transfer(Archive& archive);

private:
  ContactInputs inputs;
  std::size_t solid_count;
  std::vector<ContactPair> list;                 ///< pairs with rigid bodies first, solid by solid
  std::size_t with_rigid = 0;                    ///< number of pairs of a solid and a rigid body
  std::vector<std::unique_ptr<ContactLaw>> laws; ///< laws in use between solids
};

} // namespace spall
