#pragma once

#include "macro/scene/scene_inputs.h"
#include "macro/setup/run_inputs.h"

#include <string>

namespace spall {

/// Checks that bodies of a material that softens are computed with the scheme that is verified for them,
/// sub-points. Against converged finite elements (data/studies/README.md, set U) the other schemes do not
/// converge, or miss the exit velocity in three dimensions by 13 m/s of 238. @throws InputError unless the
/// input accepts unverified schemes. `file` names the input
void check_schemes(const SceneInputs& scene, const RunInputs& inputs, const std::string& file);

} // namespace spall
