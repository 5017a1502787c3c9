#pragma once

#include "macro/dynamics/body_motion.h"
#include "macro/dynamics/simulation.h"

#include <cmath>
#include <limits>

namespace spall {

/// Whether a body, rigid or deformable, is called "projectile".
bool has_projectile(const Simulation& run);
/// How it moves now. All ranks must call it.
BodyMotion projectile_of(const Simulation& run);

/// When the projectile's tail has passed a plane, and how fast.
struct Exit {
  double plane = std::numeric_limits<double>::infinity(); ///< z, m
  double time = std::numeric_limits<double>::quiet_NaN(), speed = time;

  bool happened() const { return !std::isnan(time); }
};

/// Follows the projectile through a run.
struct ProjectileWatch {
  Exit exit;      ///< from the slab
  BodyMotion now; ///< at the end of the last step

  /// After every step, and before the first one. All ranks must call it.
  void look(const Simulation& run);
  void transfer(Archive& archive) { archive("exit", exit); }
};

} // namespace spall
