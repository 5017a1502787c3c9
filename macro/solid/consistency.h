#pragma once

#include "macro/integration/gradient_rows.h"
#include "shared/ranks.h"

#include <cmath>
#include <functional>
#include <vector>

namespace spall {

/// Largest number of conjugate-gradient iterations, and the residual in units of the first at which they end.
/// The operator is a discrete biharmonic one: about as many iterations as points along the body, squared.
inline constexpr int consistency_iterations = 2000;
inline constexpr double consistency_tolerance = 1e-8;

/// A row's deviation from the best linear field over its own points: residual[p] = lambda_p - (least-squares
/// linear fit of lambda)_p. It is orthogonal to constants and linears, so that a multiple of it may be added
/// to the row's gradient without touching what the gradient reproduces. Zero where the points have no volume.
template<class T>
void linear_residual(const GradientRows<T>& rows, std::uint32_t first, std::uint32_t last,
                     const Points& points, const VectorField& lambda, std::vector<Vec3>& residual) {
  const std::size_t n = last - first;
  residual.assign(n, Vec3{});
  Vec3 mean_x{}, mean{};
  const auto at = [&](std::uint32_t p) { return rows.touched[rows.column[p]]; };
  for (std::uint32_t p = first; p < last; ++p)
    for (int c = 0; c < 3; ++c) {
      mean_x[c] += points.position.component[c][at(p)] / static_cast<double>(n);
      mean[c] += lambda.component[c][at(p)] / static_cast<double>(n);
    }
  Mat3 second{}, mixed{};
  for (std::uint32_t p = first; p < last; ++p) {
    const Vec3 x = points.position[at(p)], l = lambda[at(p)];
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) {
        second[3 * a + b] += (x[a] - mean_x[a]) * (x[b] - mean_x[b]);
        mixed[3 * a + b] += (x[a] - mean_x[a]) * (l[b] - mean[b]);
      }
  }
  const double extent = (second[0] + second[4] + second[8]) / 3;
  if (!(determinant(second) > 1e-6 * extent * extent * extent)) return;
  const Mat3 slope = multiply(inverse(second), mixed); // slope[3 a + b] = d lambda_b / d x_a
  for (std::uint32_t p = first; p < last; ++p) {
    const Vec3 x = points.position[at(p)], l = lambda[at(p)];
    for (int b = 0; b < 3; ++b) {
      double fit = mean[b];
      for (int a = 0; a < 3; ++a) fit += (x[a] - mean_x[a]) * slope[3 * a + b];
      residual[p - first][b] = l[b] - fit;
    }
  }
}

/// Conjugate gradients for a symmetric positive semidefinite operator on vectors spread over ranks. @return
/// iterations.
inline int solve_symmetric(const std::function<void(const std::vector<double>&, std::vector<double>&)>& apply,
                           std::vector<double> right, std::vector<double>& solution,
                           const Ranks& ranks = {}) {
  const auto product = [&ranks](const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return ranks.sum(sum);
  };
  solution.assign(right.size(), 0);
  std::vector<double> direction = right, image(right.size());
  double square = product(right, right);
  const double goal = square * consistency_tolerance * consistency_tolerance;
  int iteration = 0;
  for (; square > goal && iteration < consistency_iterations; ++iteration) {
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
  return iteration;
}

} // namespace spall
