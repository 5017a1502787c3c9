#pragma once

#include "macro/scene/scene_inputs.h"
#include "macro/setup/run_inputs.h"

#include <string>

namespace spall {

/// What a scene will cost and what it could do without, in lines of text: points of each body, memory, steps,
/// processor time, the simplifications it allows, and warnings where its choices are outside what has been
/// measured. Computes the scene's first steps to measure their cost; writes nothing. @throws InputError.
/// `file` names the input
std::string make_plan(const SceneInputs& scene, const RunInputs& inputs, const std::string& file);

} // namespace spall
