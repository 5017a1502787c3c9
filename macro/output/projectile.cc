#include "macro/output/projectile.h"

namespace spall {

bool has_projectile(const Simulation& run) {
  return run.bodies.solid("projectile") || run.bodies.rigid("projectile");
}

BodyMotion projectile_of(const Simulation& run) {
  if (const Solid* solid = run.bodies.solid("projectile")) return motion_of(*solid);
  return motion_of(*run.bodies.rigid("projectile"));
}

void ProjectileWatch::look(const Simulation& run) {
  if (!has_projectile(run)) return;
  now = projectile_of(run);
  if (std::isinf(exit.plane) || exit.happened()) return;
  if (now.rear > exit.plane && now.speed() > 0) exit.time = run.time, exit.speed = now.speed();
}

} // namespace spall
