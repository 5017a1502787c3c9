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
  int applications = 0; ///< number of applications of the operator
};

/// y = A x
using Operator = std::function<void(const std::vector<double>& x, std::vector<double>& y)>;

/// Largest eigenvalue of a symmetric operator by Lanczos' method without reorthogonalisation (lack of it only
/// repeats converged eigenvalues), from a random start, the same every time. Vectors may be spread over
/// ranks, which all call it and get the same estimate.
/// @param size length of this rank's part of a vector
/// @param tolerance the iteration stops when the residual is below this part of the value
/// @param first number of this rank's first component through all ranks
EigenvalueEstimate largest_eigenvalue(std::size_t size, const Operator& apply, double tolerance,
                                      int most_applications, const Ranks& ranks = {},
                                      std::uint64_t first = 0);

} // namespace spall
