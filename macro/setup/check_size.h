#pragma once

#include "macro/scene/scene_inputs.h"
#include "shared/ranks.h"

#include <string>

namespace spall {

/// Refuses a scene whose points cannot fit into the memory of this machine, before any point is made.
/// @param file names the input in messages @throws InputError: points, memory that they need, and what there
/// is
void check_size(const SceneInputs& scene, const Ranks& ranks, const std::string& file);

} // namespace spall
