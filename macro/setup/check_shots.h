#pragma once

#include "macro/output/answers.h"
#include "macro/setup/run_inputs.h"

#include <string>

namespace spall {

/// Points over a projectile's radius: fewer than `fewest_across` mean more than about 8 m/s of error in the
/// exit velocity of the 127 mm slab, fewer than `good_across` more than 4 m/s (data/studies).
constexpr double fewest_across = 3, good_across = 5;

/// Resolution of the points of a target in relation to a projectile.
struct ShotResolution {
  double radius = 0;  ///< radius of the projectile, m
  double spacing = 0; ///< smallest spacing of the target's points in the path, or of all its points if there
                      ///< is none in it, m
  bool meets_points = false; ///< whether the projectile, flying straight on, touches a point

  double across() const { return radius / spacing; } ///< number of points over the radius
};

/// Returns the resolution for a body that flies at a deformable target. All ranks must call it.
ShotResolution resolution_of(const SceneInputs& scene, const Simulation& run, const std::string& body,
                             const std::string& target);

/// Checks the shots that the answers are about before the first step. Contact acts on points, so a projectile
/// that is thinner than their spacing slips between them: it is refused. Few points over the radius give a
/// warning. All ranks must call it. @throws InputError. `file` names the input
void check_shots(Simulation& run, const SceneInputs& scene, const Answers& answers, const std::string& file);

} // namespace spall
