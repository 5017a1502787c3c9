#pragma once

#include "macro/dynamics/simulation.h"
#include "macro/scene/scene_inputs.h"

namespace spall::test {

/// The paper's aluminium (Table 2).
inline J2 aluminium() {
  J2 m;
  m.youngs_modulus = 78.6e9, m.poisson_ratio = 0.33, m.initial_yield = 420e6, m.hardening_modulus = 0;
  m.density = 2700;
  return m;
}

/// An aluminium Taylor bar of a few hundred points; cells are cubes of 1 mm.
inline SceneInputs small_bar(Boundary boundary = Boundary::centred, std::vector<std::string> symmetry = {}) {
  SceneInputs s;
  s.kind = SceneKind::taylor;
  s.symmetry = std::move(symmetry);
  s.diameter = 8e-3, s.height = 8e-3;
  s.filling = {4, 8, boundary};
  s.material = aluminium();
  s.impact_velocity = 373;
  return s;
}

inline Simulation simulate(const SceneInputs& s) {
  const SolidInputs numerics;
  return {make_solid(s.material.material(), make_points(s), s.planes(), numerics), make_rigid_body(s),
          s.contact, TimeInputs{.end_time = 1}, numerics.integration};
}

} // namespace spall::test
