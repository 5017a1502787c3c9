#pragma once

#include "macro/contact/carried_surface.h"
#include "macro/contact/contact_law.h"

#include <deque>
#include <optional>

namespace spall {

/// The points of several bodies that are near a body they touch, of all ranks and in the order of their
/// numbers: all that contact between bodies works on. Impulses depend on each other across the whole contact,
/// so every rank has the whole zone, does the same work on it and keeps what its own points get from it: the
/// result does not depend on the number of ranks, and what contact remembers is the same on all of them. The
/// zone is small, a surface layer of the bodies, and empty while the bodies are apart.
class ContactZone {
public:
  /// Takes the points inside the boxes around the other bodies of their pairs, `margin` of the largest
  /// spacings wider, and makes their images. All ranks must call it.
  void gather(const std::vector<ContactBody>& bodies, const std::vector<ContactPair>& pairs, double margin);

  /// The parts of the bodies in the zone, with images but no remote points; some may have no points.
  const std::vector<ContactBody>& bodies() const { return views; }

  /// Gives the bodies the velocities and forces that their points have in the zone.
  void give_back(const std::vector<ContactBody>& bodies) const;

private:
  /// What the zone has of one body.
  struct Part {
    Points points = {};
    Ghosts ghosts;
    std::vector<std::uint64_t> numbers = {}; ///< through all ranks
    std::optional<KnownSurface> surface = {};
    std::vector<std::uint32_t> chosen = {}; ///< of this rank's points
    std::size_t first = 0;                  ///< place of the first of those in the zone
  };
  /// Brings the chosen points of all ranks together.
  void fill(const std::vector<ContactBody>& bodies, const std::vector<ContactPair>& pairs, double margin);
  void add_images();

  std::deque<Part> parts; ///< that stay where they are
  std::vector<ContactBody> views;
};

} // namespace spall
