#include "macro/solid/lanczos.h"

#include <Eigen/Eigenvalues>

#include <cmath>
#include <numeric>

namespace spall {
namespace {

using Vector = std::vector<double>;

/// Fewest applications of the operator, because a start vector near another eigenvector converges to that one
/// first.
constexpr int fewest_applications = 8;

/// Returns a number uniform in (-1, 1) that depends on the number of the component alone: SplitMix64 (Steele,
/// Lea & Flood 2014).
double random_component(std::uint64_t number) {
  std::uint64_t z = (number + 1) * 0x9e3779b97f4a7c15;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
  z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
  return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-52 - 1;
}
void add(Vector& a, double factor, const Vector& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] += factor * b[i];
}
void scale(Vector& a, double factor) {
  for (double& x : a) x *= factor;
}

} // namespace

EigenvalueEstimate largest_eigenvalue(std::size_t size, const Operator& apply, double tolerance,
                                      int most_applications, const Ranks& ranks, std::uint64_t first) {
  const auto dot = [&ranks](const Vector& a, const Vector& b) {
    return ranks.sum(std::inner_product(a.begin(), a.end(), b.begin(), 0.0));
  };
  Vector v(size), last(size, 0.0), w(size);
  for (std::size_t i = 0; i < size; ++i) v[i] = random_component(first + i);
  scale(v, 1 / std::sqrt(dot(v, v)));
  Eigen::VectorXd diagonal(most_applications), off(most_applications);
  EigenvalueEstimate estimate;
  for (int k = 0; k < most_applications; ++k) {
    apply(v, w);
    diagonal[k] = dot(v, w);
    add(w, -diagonal[k], v);
    if (k > 0) add(w, -off[k - 1], last);
    off[k] = std::sqrt(dot(w, w));
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz;
    ritz.computeFromTridiagonal(diagonal.head(k + 1), off.head(k));
    estimate = {ritz.eigenvalues()[k], off[k] * std::abs(ritz.eigenvectors()(k, k)), k + 1};
    if (!(off[k] > 1e-14 * estimate.value)) break; // the Krylov space is exhausted, or a value is not finite
    if (k + 1 >= fewest_applications && estimate.residual <= tolerance * estimate.value) break;
    last.swap(v);
    v = w;
    scale(v, 1 / off[k]);
  }
  return estimate;
}

} // namespace spall
