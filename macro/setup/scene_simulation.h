#pragma once

#include "macro/dynamics/simulation.h"
#include "macro/scene/scene_inputs.h"
#include "macro/setup/run_inputs.h"

namespace spall {

/// Everything a scene file describes, ready to run: fills the bodies, loads the damage table, places the
/// rigid body. @throws InputError
Simulation make_simulation(SceneInputs& scene, const RunInputs& inputs);

} // namespace spall
