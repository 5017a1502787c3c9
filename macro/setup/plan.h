#pragma once

#include "macro/scene/scene_inputs.h"
#include "macro/setup/run_inputs.h"

#include <string>

namespace spall {

/// Returns the expected cost of a scene and possible simplifications, in lines of text: points of each body,
/// numerical error of the answers, memory, steps, processor time, and warnings where its choices are outside
/// what has been measured. Computes the scene's first steps to measure their cost; writes nothing. @throws
/// InputError
/// @param file name of the input, for messages
std::string make_plan(const SceneInputs& scene, const RunInputs& inputs, const std::string& file);

} // namespace spall
