#pragma once

#include "macro/output/length_answer.h"
#include "tests/support/small_bar.h"
#include "tests/verification/macro/bodies.h"

namespace spall::test {

/// Makes the paper's aluminium bar (sections 3.1 and 4.1) at a chosen resolution.
inline Bar aluminium_bar(int rings, int layers, const std::vector<std::string>& symmetry) {
  return {.diameter = 7.62e-3,
          .height = 23.47e-3,
          .filling = {rings, layers, Boundary::on_surface},
          .planes = planes_of(symmetry)};
}
inline Simulation shoot(const Bar& bar, const Numerics& numerics = {.double_precision = false}) {
  return bar.shoot(numerics.solid(), {.end_time = 1, .step_factor = numerics.step_factor});
}
inline void until_rebound(Simulation& run) {
  while (run.energies.points_momentum < 0 && run.time < 200e-6) run.advance();
}
inline BarShape shape_of(const Simulation& run) {
  return measure_bar(*run.bodies.solids[0], Boundary::on_surface);
}

/// Returns the shape of the bar at rebound, and prints it with the energy error.
inline BarShape shape_at_rebound(Simulation& run, const Bar& bar) {
  until_rebound(run);
  const BarShape shape = shape_of(run);
  std::printf("L/L0 %.4f, foot %.2f mm, plastic strain 95 %% quantile %.3f, mean %.4f, energy error %.1e\n",
              shape.length / bar.height, shape.foot_diameter * 1e3, shape.plastic_strain_95,
              shape.mean_plastic_strain, run.energies.error());
  return shape;
}

} // namespace spall::test
