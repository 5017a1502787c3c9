#include "macro/contact/elastic_ring.h"

#include <algorithm>
#include <cmath>

namespace spall {

ElasticRing::ElasticRing(const RingInputs& inputs_, const Points& points, double radius, double area,
                         const Ranks& ranks_)
    : inputs(inputs_), ranks(ranks_), middle_radius(radius + 0.5 * inputs_.thickness) {
  double volume = 0;
  for (std::size_t i = 0; i < points.owned; ++i)
    if (points.faces[i] & rim_face) volume += points.volume[i];
  area_per_volume = area / ranks.sum(volume);
  find_rim(points);
}

void ElasticRing::find_rim(const Points& points) {
  rim.clear(), areas.clear();
  for (std::size_t i = 0; i < points.owned; ++i)
    if (points.faces[i] & rim_face) {
      rim.push_back(static_cast<std::uint32_t>(i));
      areas.push_back(area_per_volume * points.volume[i]);
    }
  for (std::vector<double>* values : {&displacements, &velocities, &stresses})
    values->assign(rim.size(), 0.0);
}

double ElasticRing::apply(Points& points, double dt, double kick) {
  double loss = 0;
  for (std::size_t s = 0; s < rim.size(); ++s) {
    const std::uint32_t i = rim[s];
    const double ring_mass = inputs.density * inputs.thickness * areas[s];
    velocities[s] -= kick * pull(s) / ring_mass;

    const Vec3 x = points.position[i], start = points.initial_position[i];
    const double r = std::hypot(x[0], x[1]);
    if (!(r > 0)) continue;
    const Vec3 outward = {x[0] / r, x[1] / r, 0};
    const double gap = displacements[s] - (r - std::hypot(start[0], start[1]));
    const double opening = velocities[s] - dot(points.velocity[i], outward);
    // This change of the relative velocity makes the overlap zero at the end of the step.
    const double change = -gap / dt - opening;
    if (!(change > 0)) continue;
    const double impulse = change / (1 / points.mass[i] + 1 / ring_mass);
    // The work of an impulse is its product with the mean of the velocities before and after all velocity
    // changes.
    const double kicks = -kick * (pull(s) / ring_mass + dot(points.force[i], outward) / points.mass[i]);
    loss -= impulse * (opening - 0.5 * kicks + 0.5 * change);
    velocities[s] += impulse / ring_mass;
    for (int c = 0; c < 2; ++c) points.velocity.component[c][i] -= impulse / points.mass[i] * outward[c];
  }
  return loss;
}

void ElasticRing::move(double dt) {
  last_work += step_work;
  step_work = 0;
  for (std::size_t s = 0; s < rim.size(); ++s) {
    const double before = pull(s), step = dt * velocities[s];
    displacements[s] += step;
    stresses[s] = std::clamp(stresses[s] + inputs.youngs_modulus * step / middle_radius, -inputs.yield_stress,
                             inputs.yield_stress);
    step_work += 0.5 * (before + pull(s)) * step;
  }
}

double ElasticRing::kinetic_energy() const {
  double sum = 0;
  for (std::size_t s = 0; s < rim.size(); ++s)
    sum += 0.5 * inputs.density * inputs.thickness * areas[s] * velocities[s] * velocities[s];
  return sum;
}

void ElasticRing::transfer(Archive& archive) {
  archive.pieces(name, rim.size(), [this](std::size_t s, Archive& segment) {
    segment("ring_displacement", displacements[s]);
    segment("ring_velocity", velocities[s]);
    segment("ring_stress", stresses[s]);
  });
  // A sum over the ranks does not depend on how its parts are distributed, except for round-off.
  double all = ranks.sum(last_work), last_step = ranks.sum(step_work);
  archive("ring_work", all);
  archive("ring_work", last_step);
  const bool as_it_was = archive.of_rank([this](Archive& part) {
    for (double* work : {&last_work, &step_work}) part("ring_work", *work);
  });
  if (!as_it_was) last_work = ranks.first() ? all : 0, step_work = ranks.first() ? last_step : 0;
}

} // namespace spall
