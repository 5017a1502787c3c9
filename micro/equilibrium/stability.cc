#include "micro/equilibrium/stability.h"

#include "micro/equilibrium/linearisation.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <cmath>
#include <limits>

namespace spall {
namespace {

/// Round-off of an eigenvalue, relative to the largest.
constexpr double neutral = 1e-11;

} // namespace

template<int dim> Stability stability(const InterfaceProblem<dim>& problem, const CellState<dim>& state) {
  const double E = problem.youngs_modulus, l = problem.cell_size;
  Linearisation<dim> linear(problem, state);
  linear.update(E * l * (problem.cell.coupling * state.strain), state.opening);
  Stability result;
  result.lowest = std::numeric_limits<double>::quiet_NaN();
  const auto n = static_cast<Eigen::Index>(linear.free.size());
  if (n == 0) return result;
  Eigen::VectorXd root(n); // of the length or area the node stands for
  for (Eigen::Index a = 0; a < n; ++a)
    root[a] = std::sqrt(problem.cell.nodes[linear.free[a] / dim].weight * l);
  Eigen::MatrixXd tangent = linear.tangent();
  tangent = (0.5 * (tangent + tangent.transpose())).eval();
  tangent = (root.cwiseInverse().asDiagonal() * tangent * root.cwiseInverse().asDiagonal()).eval();

  Eigen::VectorXd mode;
  const Eigen::LLT<Eigen::MatrixXd> factor(tangent);
  if (factor.info() == Eigen::Success) {
    // Inverse iteration from a rough vector: no symmetry must hide a mode.
    mode = Eigen::VectorXd::LinSpaced(n, 1, 2);
    mode.normalize();
    for (int i = 0; i < 200; ++i) {
      const Eigen::VectorXd next = factor.solve(mode);
      const double value = 1 / next.norm();
      mode = next * value;
      const bool settled = std::abs(value * l / E - result.lowest) <= 1e-6 * std::abs(result.lowest);
      result.lowest = value * l / E;
      if (settled) break;
    }
  } else {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> all(tangent);
    result.lowest = all.eigenvalues()[0] * l / E;
    result.negative =
        static_cast<int>((all.eigenvalues().array() < -neutral * all.eigenvalues()[n - 1]).count());
    mode = all.eigenvectors().col(0);
  }
  result.mode = Eigen::VectorXd::Zero(state.opening.size());
  result.mode(linear.free) = mode.cwiseQuotient(root);
  Eigen::Index at = 0;
  result.mode.cwiseAbs().maxCoeff(&at);
  result.mode /= result.mode[at];
  return result;
}

template Stability stability(const InterfaceProblem<2>&, const CellState<2>&);
template Stability stability(const InterfaceProblem<3>&, const CellState<3>&);

} // namespace spall
