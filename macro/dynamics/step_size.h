#pragma once

#include "macro/dynamics/bodies.h"
#include "macro/dynamics/health.h"
#include "macro/dynamics/step_report.h"
#include "macro/dynamics/time_inputs.h"

#include <limits>
#include <vector>

namespace spall {

/// Decides before each step which shape functions are rebuilt (neighbours, paper Eqs. 6-8), and how long the
/// step is.
class StepSize {
public:
  StepSize(const TimeInputs& time, const IntegrationInputs& integration, std::size_t solids);

  /// h / c of all solids, s: the smallest, and the unit of the time step (RefreshReport).
  struct StableSteps {
    double smallest, unit;
  };
  /// Rebuilds the shape functions of the solids that need it. @throws ComputationError
  StableSteps refresh(Bodies& bodies, Health& health, double time);
  /// Length of the next step, s: the step factor's part of h / c, or less if the stiffness does not allow it.
  /// @param steps that have been made
  double choose(double stable_step, Bodies& bodies, Health& health, double time, std::size_t steps);
  /// Learns how much the neighbourhoods have changed in the step.
  void observe(const StepReport& report);

  void transfer(Archive& archive);

private:
  /// When a solid's shape functions are to be rebuilt, and the step it allows.
  struct Freshness {
    double smallest_step = 0;  ///< h / c, s
    double stable_step = 0;    ///< unit of the time step, s
    double largest_change = 0; ///< of a neighbourhood since the last refresh
    int since_refresh = 0;     ///< steps
  };
  void refresh(Solid& solid, Freshness& freshness, Health& health, double time);
  /// Estimates the largest stable step from the stiffness, and looks at the run's health.
  void look(double stable_step, Bodies& bodies, Health& health, double time, bool started);

  TimeInputs inputs;
  IntegrationInputs integration;
  std::vector<Freshness> freshness;                                ///< of each solid
  double largest_factor = std::numeric_limits<double>::infinity(); ///< of h / c, by the last estimate
};

} // namespace spall
