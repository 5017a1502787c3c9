#pragma once

#include "macro/contact/contact_inputs.h"
#include "macro/contact/contact_report.h"
#include "macro/contact/near_points.h"

#include <string>
#include <vector>

namespace spall {

/// One body touches another: the secondary one with its points, the primary one with its surface.
struct ContactPair {
  std::size_t secondary, primary; ///< numbers of the bodies: solids first, then rigid bodies
  std::string law;                ///< word of the law between them
};

/// Every two of so many deformable bodies; of two, the former is the secondary one.
inline std::vector<ContactPair> all_pairs(std::size_t bodies, const std::string& law) {
  std::vector<ContactPair> pairs;
  for (std::size_t secondary = 0; secondary < bodies; ++secondary)
    for (std::size_t primary = secondary + 1; primary < bodies; ++primary)
      pairs.push_back({secondary, primary, law});
  return pairs;
}

/// A law of contact between deformable bodies, for all the pairs that follow it. A law gives impulses before
/// the points move, or forces at the end of the step, or both. All ranks make the calls together, and get the
/// same report.
class ContactLaw {
public:
  virtual ~ContactLaw() = default;

  /// Changes the velocities of the points. They include the velocity change of the internal force over the
  /// time `kick` (s) already; a law subtracts it when it computes its work.
  virtual SolidContactReport apply_impulses(const std::vector<ContactBody>& bodies, double /*dt*/,
                                            double /*kick*/) {
    return SolidContactReport(bodies.size());
  }
  /// Adds to the forces of the points, with positions at the end of the step and velocities at its middle.
  /// The losses are the work of the whole step.
  virtual SolidContactReport add_forces(const std::vector<ContactBody>& bodies, double /*dt*/) {
    return SolidContactReport(bodies.size());
  }
  /// Transfers the state that the next step depends on; it is the same on all ranks.
  virtual void transfer(Archive&) {}
};

} // namespace spall
