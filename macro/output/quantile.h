#pragma once

#include "shared/ranks.h"

#include <vector>

namespace spall {

/// The smallest value up to which the weights add up to at least `reach`, over the values of all ranks, which
/// must call it together: found by halving the range of numbers, so that no rank sees them all.
/// No number (NaN) if the weights of all values together do not reach it, as when there are no values.
double weighted_quantile(const std::vector<double>& values, const std::vector<double>& weights, double reach,
                         const Ranks& ranks);

} // namespace spall
