#pragma once

#include "macro/dynamics/simulation.h"
#include "macro/setup/run_inputs.h"

#include <string>

namespace spall {

/// Checks every deformable body before the first step: the points around each point hold the linear basis, so
/// that a linear displacement is reproduced, and the body is one piece. Cells that are far from cubes fail,
/// since the support of a point is a sphere whose radius is a multiple of the cube root of its cell. All
/// ranks must call it. @throws InputError naming the body. `file` names the input
void check_bodies(Simulation& run, const SolidInputs& inputs, const std::string& file);

} // namespace spall
