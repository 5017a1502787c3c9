#pragma once

#include "shared/ranks.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace spall {

/// Estimate of an extreme eigenvalue: an eigenvalue lies within `residual` of `value`.
struct EigenvalueEstimate {
  double value = 0, residual = 0;
  int applications = 0; ///< of the operator
};

/// y = A x
using Operator = std::function<void(const std::vector<double>& x, std::vector<double>& y)>;

/// Largest eigenvalue of a symmetric operator on vectors of `size` numbers by Lanczos' method without
/// reorthogonalisation (which only repeats converged eigenvalues), from a random start, the same every time.
/// Stops when the residual is below `tolerance` times the value. Vectors may be spread over ranks, which all
/// call it: `size` is this rank's part, `first` the number of its first component through all ranks.
EigenvalueEstimate largest_eigenvalue(std::size_t size, const Operator& apply, double tolerance,
                                      int most_applications, const Ranks& ranks = {},
                                      std::uint64_t first = 0);

} // namespace spall
