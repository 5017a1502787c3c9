#pragma once

#include "macro/contact/rigid_body.h"
#include "macro/shape/sizes.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace spall {

/// Rigid bodies have no contact with each other. This tells which pairs could meet, and when one does, so
/// that no run goes on in which they pass through each other. Pairs of held bodies do not count.
class RigidPairs {
public:
  explicit RigidPairs(const std::vector<RigidBody>& bodies);

  using Pair = std::pair<std::string, std::string>;
  /// Pairs whose paths cross if nothing deflects the bodies, whenever each of them is there: targets slow
  /// them down. A path is as wide as the body across it.
  static std::vector<Pair> crossing(const std::vector<RigidBody>& bodies);
  /// The first pair that overlaps now: a sample of the surface of one lies inside the other by more than a
  /// thousandth of the smaller size of the two.
  std::optional<Pair> overlapping(const std::vector<RigidBody>& bodies);

private:
  struct Two {
    std::size_t a, b;
    double size; ///< of the smaller one, m
    /// Samples of the surfaces, in the frames of the bodies, m: made when these come near each other.
    std::vector<Vec3> of_a = {}, of_b = {};
    double depth = 0; ///< beyond which they overlap, m
  };
  std::vector<Two> pairs;
  std::vector<BoundingBall> balls; ///< around the bodies
};

} // namespace spall
