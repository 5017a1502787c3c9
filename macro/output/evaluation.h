#pragma once

#include "shared/ranks.h"

#include <functional>
#include <string>
#include <vector>

namespace spall {

/// What evaluations of a run could not say, in words.
using Warnings = std::vector<std::string>;

/// Runs an evaluation. Nothing that has been computed may be lost because it fails: what it throws becomes a
/// warning that begins with `what`. All ranks must call it. With several ranks only errors that all of them
/// get can be left behind (InputError, ComputationError); others are thrown on, as the other ranks wait.
/// @return whether it came to its end
bool evaluate(const std::string& what, const std::function<void()>& evaluation, Warnings& warnings,
              const Ranks& ranks);

} // namespace spall
