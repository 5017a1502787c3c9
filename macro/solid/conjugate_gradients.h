#pragma once

#include "shared/ranks.h"

#include <cmath>
#include <functional>
#include <vector>

namespace spall {

/// Result of the solution of a linear system.
struct SolverReport {
  int iterations = 0;
  double residual = 0; ///< residual at the end over that at the start
  bool converged = false;
};

/// Largest number of conjugate-gradient iterations, and the residual, in units of the first, at which they
/// end. The operator of the linear correction is a discrete biharmonic one: it takes about as many iterations
/// as there are points along the body, squared.
inline constexpr int most_iterations = 2000;
inline constexpr double solver_tolerance = 1e-8;

/// Solves A x = b by conjugate gradients (Hestenes and Stiefel 1952), from x = 0, for a symmetric positive
/// semidefinite A and vectors that may be spread over ranks, which all call it and get the same report.
/// @param apply y = A x
/// @param right b on entry, the residual b - A x on return
/// @param solution x on return
inline SolverReport
solve_symmetric(const std::function<void(const std::vector<double>& x, std::vector<double>& y)>& apply,
                std::vector<double>& right, std::vector<double>& solution, const Ranks& ranks = {},
                int limit = most_iterations) {
  const auto product = [&ranks](const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return ranks.sum(sum);
  };
  solution.assign(right.size(), 0);
  std::vector<double> direction = right, image(right.size());
  double square = product(right, right);
  const double first = square, goal = square * solver_tolerance * solver_tolerance;
  SolverReport report;
  for (; square > goal && report.iterations < limit; ++report.iterations) {
    apply(direction, image);
    const double step = square / product(direction, image);
    for (std::size_t i = 0; i < right.size(); ++i) {
      solution[i] += step * direction[i];
      right[i] -= step * image[i];
    }
    const double next = product(right, right);
    for (std::size_t i = 0; i < right.size(); ++i) direction[i] = right[i] + next / square * direction[i];
    square = next;
  }
  report.converged = square <= goal; // false if it is not a number
  report.residual = first > 0 ? std::sqrt(square / first) : 0;
  return report;
}

} // namespace spall
