#include "macro/setup/check_shots.h"

#include "macro/contact/rigid_pairs.h"
#include "macro/scene/placement.h"
#include "shared/error.h"

#include <algorithm>
#include <cstdio>
#include <limits>

namespace spall {
namespace {

/// A projectile with fewer points over its radius can pass between them.
constexpr double least_across = 1;

} // namespace

ShotResolution resolution_of(const SceneInputs& scene, const Simulation& run, const std::string& body,
                             const std::string& target) {
  const BodyInputs& projectile = *scene.find(body);
  const Solid& solid = *run.bodies.solid(target);
  const Points& points = solid.points;
  const Vec3 start = place_bodies(scene, "scene").at(body).origin,
             velocity = projectile.motion.velocity_vector();
  const Vec3 flight = 1 / norm(velocity) * velocity;
  ShotResolution seen{.radius = extent(projectile.solid_shape(), {1, 0, 0})};
  constexpr double none = std::numeric_limits<double>::infinity();
  double in_path = none, anywhere = none;
  for (std::size_t i = 0; i < points.owned; ++i) {
    const Vec3 from_start = points.position[i] - start;
    const double beside = norm(from_start - dot(from_start, flight) * flight), spacing = points.spacing[i];
    anywhere = std::min(anywhere, spacing);
    if (beside < seen.radius + points.surface_offset * spacing) in_path = std::min(in_path, spacing);
  }
  const Ranks& ranks = solid.ghosts.processes();
  in_path = ranks.min(in_path), anywhere = ranks.min(anywhere);
  seen.meets_points = in_path < none;
  seen.spacing = seen.meets_points ? in_path : anywhere;
  return seen;
}

namespace {

/// Bars touch rigid bodies only: says so where another deformable body flies.
void warn_of_bars(Simulation& run, const SceneInputs& scene) {
  for (const Reinforcement& bars : run.bodies.reinforcements)
    for (const BodyInputs& body : scene.bodies)
      if (body.is_deformable() && body.motion.velocity != 0 && body.name != run.bodies.name(bars.solid))
        run.health.warnings.push_back("the '" + bars.name + "' touch rigid bodies only: '" + body.name +
                                      "', which is deformable, goes through them");
}

/// Surfaces of files that were inside out: says that they were turned round.
void warn_of_turned_surfaces(Simulation& run, const SceneInputs& scene) {
  for (const BodyInputs& body : scene.bodies) {
    if (!body.has_shape() || body.shape.kind != ShapeKind::surface) continue;
    if (std::get<ClosedSurface>(body.solid_shape()).was_turned())
      run.health.warnings.push_back("the surface of '" + body.name +
                                    "' was inside out in its file and has been turned round");
  }
}

/// Rigid bodies have no contact with each other: says so where they could meet.
void warn_of_rigid_pairs(Simulation& run) {
  const std::vector<RigidPairs::Pair> pairs = RigidPairs::crossing(run.bodies.rigids);
  constexpr std::size_t most_named = 3;
  if (pairs.size() > most_named)
    run.health.warnings.push_back("the paths of " + std::to_string(pairs.size()) +
                                  " pairs of rigid bodies cross, of which the first are named");
  for (std::size_t k = 0; k < std::min(pairs.size(), most_named); ++k) {
    const auto& [one, other] = pairs[k];
    run.health.warnings.push_back("the paths of the rigid bodies '" + one + "' and '" + other +
                                  "' cross; rigid bodies do not touch each other, so the run stops if these "
                                  "meet: one of them must be deformable then");
  }
}

} // namespace

void check_shots(Simulation& run, const SceneInputs& scene, const Answers& answers, const std::string& file) {
  warn_of_bars(run, scene);
  warn_of_turned_surfaces(run, scene);
  warn_of_rigid_pairs(run);
  for (const auto& [body, target] : answers.shots()) {
    const ShotResolution seen = resolution_of(scene, run, body, target);
    char text[500];
    if (!seen.meets_points || seen.across() < least_across) {
      std::snprintf(
          text, sizeof text,
          ": the points of '%s' are too far apart for '%s': its radius is %.4g mm, their spacing %.4g "
          "mm%s; make the spacing at most a third of the radius (Rings and Layers, or Fine spacing)",
          target.c_str(), body.c_str(), seen.radius * 1e3, seen.spacing * 1e3,
          seen.meets_points ? "" : ", and none of them is in its path");
      throw InputError(file + text);
    }
    if (seen.across() >= fewest_across) continue;
    std::snprintf(text, sizeof text,
                  "only %.1f points of '%s' over the radius of '%s'; use at least %.0f (about 8 m/s of error "
                  "in the exit velocity of the 127 mm slab), better %.0f (4 m/s)",
                  seen.across(), target.c_str(), body.c_str(), fewest_across, good_across);
    run.health.warnings.push_back(text);
  }
}

} // namespace spall
