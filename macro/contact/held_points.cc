#include "macro/contact/held_points.h"

#include "shared/error.h"
#include "shared/input/quantity.h"

#include <cmath>
#include <utility>

namespace spall {

void Reaction::list(Reduction& of_ranks) {
  for (Vec3* vector : {&impulse, &angular})
    for (double& component : *vector) of_ranks.sums.push_back(&component);
  of_ranks.sums.push_back(&loss);
}

HeldPoints::HeldPoints(const BodySupportInputs& inputs_, const Vec3& centre_, const Points& points,
                       const Ranks& ranks, std::string body)
    : inputs(inputs_), centre(centre_) {
  find(points);
  if (ranks.sum(static_cast<double>(held.size())) == 0)
    throw InputError("key '" + std::move(body) + "/Support diameter': found " +
                     format_quantity(inputs.diameter, Dimension::length) +
                     ", but no point of the upper face is within half a spacing of this ring");
}

bool HeldPoints::holds(const Points& points, std::size_t i) const {
  const std::uint8_t faces = points.faces[i];
  if (inputs.kind == BodySupportKind::clamped) return (faces & rim_face) != 0;
  if ((faces & high_face) == 0) return false;
  if (inputs.diameter == 0) return (faces & rim_face) != 0;
  const Vec3 x = points.initial_position[i] - centre;
  return std::abs(std::hypot(x[0], x[1]) - 0.5 * inputs.diameter) <= 0.5 * points.spacing[i];
}

void HeldPoints::find(const Points& points) {
  held.clear();
  if (inputs.kind == BodySupportKind::none) return;
  for (std::size_t i = 0; i < points.owned; ++i)
    if (holds(points, i)) held.push_back(static_cast<std::uint32_t>(i));
}

Reaction HeldPoints::take_forces(Points& points, double duration) const {
  Reaction step;
  for (const std::uint32_t i : held) {
    const Vec3 force = points.force[i];
    const Vec3 reaction = inputs.kind == BodySupportKind::clamped ? Vec3{} - force : Vec3{0, 0, -force[2]};
    points.force.add(i, reaction);
    step.impulse += duration * reaction;
    step.angular += cross(points.position[i], duration * reaction);
  }
  return step;
}

void HeldPoints::stop(Points& points, Reaction& step) const {
  for (const std::uint32_t i : held) {
    const Vec3 velocity = points.velocity[i];
    const Vec3 change =
        inputs.kind == BodySupportKind::clamped ? Vec3{} - velocity : Vec3{0, 0, -velocity[2]};
    points.velocity.add(i, change);
    const double mass = points.mass[i];
    step.impulse += mass * change;
    step.angular += cross(points.position[i], mass * change);
    step.loss += 0.5 * mass * dot(change, change);
  }
}

} // namespace spall
