#include "macro/dynamics/step_size.h"

#include "shared/error.h"
#include "shared/input/quantity.h"
#include "shared/traffic.h"

#include <algorithm>
#include <cmath>

namespace spall {
namespace {

/// Part of the largest stable step that is used when the step factor asks for more: between two estimates the
/// stiffness grows by compression and by the stress, which the estimate leaves out.
constexpr double critical_part = 0.9;

} // namespace

StepSize::StepSize(const TimeInputs& time, const IntegrationInputs& integration_, std::size_t solids)
    : inputs(time), integration(integration_),
      freshness(solids, Freshness{.since_refresh = integration_.refresh_interval}) {}

StepSize::StableSteps StepSize::refresh(Bodies& bodies, Health& health, double time) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  StableSteps steps{infinite, infinite};
  for (std::size_t s = 0; s < freshness.size(); ++s) {
    refresh(*bodies.solids[s], freshness[s], health, time);
    steps.smallest = std::min(steps.smallest, freshness[s].smallest_step);
    steps.unit = std::min(steps.unit, freshness[s].stable_step);
  }
  return steps;
}

void StepSize::refresh(Solid& solid, Freshness& f, Health& health, double time) {
  if (f.since_refresh < integration.refresh_interval && f.largest_change < integration.refresh_deformation) {
    f.since_refresh += inputs.subcycles;
    return;
  }
  const TrafficOf use(MpiUse::refreshes);
  const RefreshReport report = solid.refresh({integration.least_deformation, integration.most_skipped});
  health.note(report);
  if (!(report.stable_step > 0) || !std::isfinite(report.stable_step))
    throw ComputationError("t = " + in_six_digits(time * 1e6) + " us: the stable time step of '" +
                           solid.label + "' is " + std::to_string(report.stable_step) + " s");
  f = {.smallest_step = report.smallest_step,
       .stable_step = report.stable_step,
       .largest_change = 0,
       .since_refresh = inputs.subcycles};
}

double StepSize::choose(double stable_step, Bodies& bodies, Health& health, double time, std::size_t steps) {
  const auto every = static_cast<std::size_t>(inputs.verify_every),
             cycle = static_cast<std::size_t>(inputs.subcycles);
  if (every > 0 && (steps == 0 || steps / every != (steps - cycle) / every))
    look(stable_step, bodies, health, time, steps > 0);
  return std::min(inputs.step_factor, largest_factor) * stable_step / std::sqrt(2 * inputs.gamma);
}

void StepSize::look(double stable_step, Bodies& bodies, Health& health, double time, bool started) {
  const TrafficOf use(MpiUse::looks);
  double critical = std::numeric_limits<double>::infinity();
  for (const auto& solid : bodies.solids) {
    const double step = solid->critical_step();
    if (!(step > 0))
      throw ComputationError("t = " + in_six_digits(time * 1e6) + " us: the largest stable step of '" +
                             solid->label + "' is estimated as " + std::to_string(step) + " s");
    critical = std::min(critical, step);
  }
  // In units of h / c, which follows the deformation until the next estimate.
  largest_factor = critical_part * critical / stable_step;
  health.smallest_step_margin =
      std::min(health.smallest_step_margin, critical / (inputs.step_factor * stable_step));
  if (!(inputs.step_factor <= largest_factor))
    health.note_short_step(largest_factor, inputs.step_factor, time);
  if (started) health.look(bodies, time);
}

void StepSize::observe(const StepReport& report) {
  for (std::size_t s = 0; s < freshness.size(); ++s)
    freshness[s].largest_change =
        std::max(freshness[s].largest_change, report.solids[s].stresses.largest_change);
}

void StepSize::transfer(Archive& archive) {
  archive("freshness", freshness);
  archive("largest_factor", largest_factor);
}

} // namespace spall
