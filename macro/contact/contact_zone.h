#pragma once

#include "macro/contact/carried_surface.h"
#include "macro/contact/contact_law.h"

#include <deque>
#include <optional>

namespace spall {

/// The points of several bodies that are near a body they touch, of all ranks and in the order of their
/// numbers. Contact between bodies works on these points only. Impulses depend on each other across the whole
/// contact, so every rank holds the whole zone, does the same computation on it and uses the results of its
/// own points. So the result does not depend on the number of ranks, and the state of contact is the same on
/// all of them. The zone is small, a surface layer of the bodies, and empty while the bodies are apart.
class ContactZone {
public:
  /// Gathers the points inside the boxes around the other bodies of their pairs, which are enlarged by
  /// `margin` of the largest spacings, and makes their images. All ranks must call it.
  void gather(const std::vector<ContactBody>& bodies, const std::vector<ContactPair>& pairs, double margin);

  /// Does the same at the start of a run, when the ranks have not numbered the points of the bodies yet.
  void gather_at_start(const std::vector<ContactBody>& bodies, const std::vector<ContactPair>& pairs,
                       double margin);

  /// The parts of the bodies in the zone, with images but no remote points; some may have no points.
  const std::vector<ContactBody>& bodies() const { return views; }

  /// Copies the velocities and forces of the points in the zone to the bodies.
  void give_back(const std::vector<ContactBody>& bodies) const;

private:
  /// The part of one body in the zone.
  struct Part {
    Points points = {};
    Ghosts ghosts;
    std::vector<std::uint64_t> numbers = {}; ///< numbers of the points through all ranks
    std::optional<KnownSurface> surface = {};
    std::vector<std::uint32_t> chosen = {}; ///< this rank's points that are in the zone
    std::size_t first = 0;                  ///< place of the first of them in the zone
  };
  void gather(const std::vector<ContactBody>& bodies, const std::vector<ContactPair>& pairs, double margin,
              const std::vector<std::uint64_t>& first_numbers);
  /// Brings the chosen points of all ranks together.
  /// @param first_numbers for each body the number, through all ranks, of this rank's first point
  void fill(const std::vector<ContactBody>& bodies, const std::vector<ContactPair>& pairs, double margin,
            const std::vector<std::uint64_t>& first_numbers);
  void add_images();

  std::deque<Part> parts; ///< parts of the bodies; a deque, because views point to them
  std::vector<ContactBody> views;
};

} // namespace spall
