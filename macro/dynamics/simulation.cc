#include "macro/dynamics/simulation.h"

#include "macro/points/parallel.h"
#include "shared/error.h"

#include <cmath>

namespace spall {
namespace {

constexpr std::size_t chunk_size = 1024;

struct Sums {
  double kinetic = 0, momentum = 0;
};

/// Adds up what `part(begin, end)` gives for chunks of the points, in order.
template<class Part> Sums sum_over(std::size_t count, const Part& part) {
  std::vector<Sums> parts((count + chunk_size - 1) / chunk_size);
  for_each_index(parts.size(), [&](std::size_t p) {
    parts[p] = part(p * chunk_size, std::min(count, (p + 1) * chunk_size));
  });
  Sums sum;
  for (const Sums& s : parts) sum.kinetic += s.kinetic, sum.momentum += s.momentum;
  return sum;
}

double kinetic_energy(const RigidBody& body) {
  return std::isinf(body.mass) ? 0 : 0.5 * body.mass * dot(body.velocity, body.velocity);
}

} // namespace

Simulation::Simulation(std::unique_ptr<Solid> solid_, RigidBody body_, const ContactInputs& contact_,
                       const TimeInputs& time_, const IntegrationInputs& integration_)
    : solid(std::move(solid_)), body(body_), contact(contact_), inputs(time_), integration(integration_),
      since_refresh(integration_.refresh_interval) {
  const Points& points = solid->points;
  const Sums sums = sum_over(points.owned, [&](std::size_t begin, std::size_t end) {
    Sums s;
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3 v = points.velocity[i];
      s.kinetic += 0.5 * points.mass[i] * dot(v, v);
      s.momentum += points.mass[i] * v[2];
    }
    return s;
  });
  budget.kinetic = sums.kinetic;
  budget.points_momentum = sums.momentum;
  budget.body_kinetic = kinetic_energy(body);
  budget.initial_energy = budget.total();
  budget.momentum = budget.initial_momentum =
      sums.momentum + (std::isinf(body.mass) ? 0 : body.mass * body.velocity[2]);
}

void Simulation::advance() {
  refresh_if_needed();
  const double dt = inputs.step_factor * last_refresh.stable_step;
  move(dt);
  account(solid->update(dt, time + dt));
  time += dt;
  step = dt;
  ++steps;
}

void Simulation::refresh_if_needed() {
  if (since_refresh < integration.refresh_interval && largest_change < integration.refresh_deformation) {
    ++since_refresh;
    return;
  }
  last_refresh = solid->refresh();
  most_regularized = std::max(most_regularized, last_refresh.regularized);
  most_isolated = std::max(most_isolated, last_refresh.isolated);
  if (!(last_refresh.stable_step > 0) || !std::isfinite(last_refresh.stable_step))
    throw ComputationError("t = " + std::to_string(time * 1e6) + " us: the stable time step is " +
                           std::to_string(last_refresh.stable_step) + " s");
  since_refresh = 1;
  largest_change = 0;
  ++refreshes;
}

void Simulation::move(double dt) {
  Points& points = solid->points;
  const double half = 0.5 * (step + dt); // from the middle of the last step to the middle of this one
  sum_over(points.owned, [&](std::size_t begin, std::size_t end) {
    for (int c = 0; c < 3; ++c)
      for (std::size_t i = begin; i < end; ++i)
        points.velocity.component[c][i] += half / points.mass[i] * points.force.component[c][i];
    return Sums{};
  });
  const ContactReport report = apply_contact(points, body, contact, dt, half);
  const Sums sums = sum_over(points.owned, [&](std::size_t begin, std::size_t end) {
    Sums s;
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3 v = points.velocity[i];
      for (int c = 0; c < 3; ++c) points.position.component[c][i] += dt * v[c];
      s.kinetic += 0.5 * points.mass[i] * dot(v, v);
      s.momentum += points.mass[i] * v[2];
    }
    return s;
  });
  for (int c = 0; c < 3; ++c) body.position[c] += dt * body.velocity[c];
  budget.kinetic = sums.kinetic;
  budget.body_kinetic = kinetic_energy(body);
  budget.points_momentum = sums.momentum;
  budget.momentum = sums.momentum + (std::isinf(body.mass) ? 0 : body.mass * body.velocity[2]);
  budget.friction += report.friction_loss;
  budget.contact += report.normal_loss;
  budget.impulse -= report.impulse[2];
  contact_impulse = report.impulse;
  deepest_overlap = std::max(deepest_overlap, report.deepest);
}

void Simulation::account(const SolidReport& report) {
  // The kinetic energy is that of the middle of the step, where half of the step's work has been done.
  budget.internal = internal_work + 0.5 * report.internal_work;
  budget.stabilization = stabilization_work + 0.5 * report.stabilization_work;
  internal_work += report.internal_work;
  stabilization_work += report.stabilization_work;
  largest_change = std::max(largest_change, report.largest_change);
}

} // namespace spall
