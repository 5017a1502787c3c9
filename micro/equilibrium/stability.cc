#include "micro/equilibrium/stability.h"

#include "micro/equilibrium/linearisation.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>

namespace spall {
namespace {

/// Round-off of an eigenvalue, relative to the largest one, for symmetric and for other matrices.
constexpr double neutral = 1e-11, neutral_general = 1e-9;

Eigen::MatrixXd scaled(const Eigen::MatrixXd& tangent, const Eigen::VectorXd& areas) {
  const Eigen::VectorXd inverse_root = areas.cwiseSqrt().cwiseInverse();
  return inverse_root.asDiagonal() * tangent * inverse_root.asDiagonal();
}

} // namespace

int growing_disturbances(const Eigen::MatrixXd& tangent, const Eigen::VectorXd& areas) {
  const Eigen::EigenSolver<Eigen::MatrixXd> all(scaled(tangent, areas), false);
  const double largest = all.eigenvalues().cwiseAbs().maxCoeff();
  return static_cast<int>((all.eigenvalues().real().array() < -neutral_general * largest).count());
}

template<int dim> Stability stability(const InterfaceProblem<dim>& problem, const CellState<dim>& state) {
  const double E = problem.youngs_modulus, l = problem.cell_size;
  Linearisation<dim> linear(problem, state);
  linear.update(E * l * (problem.cell.coupling * state.strain), state.opening);
  Stability result;
  result.lowest = std::numeric_limits<double>::quiet_NaN();
  const auto n = static_cast<Eigen::Index>(linear.free.size());
  if (n == 0) return result;
  const Eigen::VectorXd areas = linear.areas();
  const Eigen::MatrixXd tangent = linear.tangent();
  Eigen::MatrixXd symmetric = scaled(tangent, areas);
  if (!problem.mode.symmetric()) symmetric = 0.5 * (symmetric + symmetric.transpose()).eval();

  Eigen::MatrixXd modes;
  const Eigen::LLT<Eigen::MatrixXd> factor(symmetric);
  if (factor.info() == Eigen::Success) {
    // The inverse iteration starts from a vector without symmetry, which could hide an eigenvector.
    Eigen::VectorXd mode = Eigen::VectorXd::LinSpaced(n, 1, 2);
    mode.normalize();
    for (int i = 0; i < 200; ++i) {
      const Eigen::VectorXd next = factor.solve(mode);
      const double value = 1 / next.norm();
      mode = next * value;
      const bool settled = std::abs(value * l / E - result.lowest) <= 1e-6 * std::abs(result.lowest);
      result.lowest = value * l / E;
      if (settled) break;
    }
    modes = mode;
  } else {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> all(symmetric);
    result.lowest = all.eigenvalues()[0] * l / E;
    const auto below = (all.eigenvalues().array() < -neutral * all.eigenvalues()[n - 1]).count();
    result.negative =
        problem.mode.symmetric() ? static_cast<int>(below) : growing_disturbances(tangent, areas);
    modes = all.eigenvectors().leftCols(std::max<Eigen::Index>(below, 1));
  }
  result.modes = Eigen::MatrixXd::Zero(state.opening.size(), modes.cols());
  for (Eigen::Index k = 0; k < modes.cols(); ++k) {
    result.modes(linear.free, k) = modes.col(k).cwiseQuotient(areas.cwiseSqrt());
    Eigen::Index at = 0;
    result.modes.col(k).cwiseAbs().maxCoeff(&at);
    result.modes.col(k) /= result.modes(at, k);
  }
  return result;
}

template Stability stability(const InterfaceProblem<2>&, const CellState<2>&);
template Stability stability(const InterfaceProblem<3>&, const CellState<3>&);

} // namespace spall
