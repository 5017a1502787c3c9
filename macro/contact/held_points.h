#pragma once

#include "macro/points/points.h"
#include "shared/ranks.h"

#include <cstdint>
#include <string>
#include <vector>

namespace spall {

/// Support of a deformable body by its surroundings.
enum class BodySupportKind {
  none,
  clamped, ///< the outermost points of its side do not move
  simple   ///< points on a ring or edge of its upper face do not move along z
};

struct BodySupportInputs {
  BodySupportKind kind = BodySupportKind::none;
  double diameter = 0; ///< diameter of the ring of a simple support, m; 0: the edge of the upper face
};

/// Reaction of the supports on a body in a step: on this rank, and after the reduction of list() on all
/// ranks.
struct Reaction {
  Vec3 impulse{}, angular{}; ///< impulse on the body, N s, and its moment about the origin, N m s
  double loss = 0;           ///< energy of points that contact pushed and the support stopped, J

  void list(Reduction& of_ranks);
  Reaction& operator+=(const Reaction& other) {
    impulse += other.impulse, angular += other.angular, loss += other.loss;
    return *this;
  }
};

/// The points of a body that a support holds. Directions that are held keep the velocity zero: the support
/// carries the force on such a point and the impulse of a contact, in tension as in compression.
class HeldPoints {
public:
  HeldPoints() = default;
  /// @param centre x and y of the axis of the body, m. @throws InputError if no point of all ranks is held
  HeldPoints(const BodySupportInputs& inputs, const Vec3& centre, const Points& points, const Ranks& ranks,
             std::string body);

  /// Removes the force in the held directions before the velocity step of `duration`, s. @return its impulse
  Reaction take_forces(Points& points, double duration) const;
  /// Stops held points that have got a velocity from contact, and adds their impulse and energy to `step`.
  void stop(Points& points, Reaction& step) const;

  /// Finds the held points among other points of this rank, after points have moved between ranks.
  void find(const Points& points);
  std::size_t count() const { return held.size(); } ///< number of held points on this rank

  std::size_t solid = 0; ///< number of the solid

private:
  bool holds(const Points& points, std::size_t i) const;

  BodySupportInputs inputs;
  Vec3 centre{};
  std::vector<std::uint32_t> held; ///< indices of the held points
};

} // namespace spall
