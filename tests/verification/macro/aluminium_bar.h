#pragma once

#include "macro/output/answers.h"
#include "macro/scene/scene_inputs.h"
#include "tests/unit/output/small_bar.h"
#include "tests/verification/macro/bodies.h"

namespace spall::test {

/// The paper's aluminium bar (sections 3.1 and 4.1) at a chosen resolution.
inline SceneInputs aluminium_bar(int rings, int layers, std::vector<std::string> symmetry) {
  SceneInputs s;
  s.kind = SceneKind::taylor;
  s.symmetry = std::move(symmetry);
  s.diameter = 7.62e-3, s.height = 23.47e-3;
  s.filling = {rings, layers, Boundary::on_surface};
  s.material = aluminium();
  s.impact_velocity = 373;
  return s;
}
inline Simulation shoot(const SceneInputs& s, const Numerics& numerics = {.double_precision = false}) {
  const SolidInputs inputs = numerics.solid();
  return {make_solid(s.material.material(), make_points(s), s.planes(), inputs), make_rigid_body(s), s.contact,
          TimeInputs{.end_time = 1, .step_factor = numerics.step_factor}, inputs.integration};
}
inline void until_rebound(Simulation& run) {
  while (run.budget.points_momentum < 0 && run.time < 200e-6) run.advance();
}

/// Shape of the bar at rebound, told with its energy error.
inline BarShape shape_at_rebound(Simulation& run, const SceneInputs& scene) {
  until_rebound(run);
  const BarShape bar = measure_bar(*run.solids[0], scene);
  std::printf("L/L0 %.4f, foot %.2f mm, plastic strain 95 %% quantile %.3f, mean %.4f, energy error %.1e\n",
              bar.length / scene.height, bar.foot_diameter * 1e3, bar.plastic_strain_95,
              bar.mean_plastic_strain, run.budget.error());
  return bar;
}

} // namespace spall::test
