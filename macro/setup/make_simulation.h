#pragma once

#include "macro/dynamics/simulation.h"
#include "macro/scene/placement.h"
#include "macro/setup/run_inputs.h"

namespace spall {

/// The points of a deformable body of a scene at its place, with their velocity. @param name of the body
Points make_points(const SceneInputs& scene, const std::string& name);

/// Everything a scene describes, ready to run: fills the bodies, prepares their materials, places rigid
/// bodies and rings. @throws InputError
Simulation make_simulation(const SceneInputs& scene, const RunInputs& inputs);

} // namespace spall
