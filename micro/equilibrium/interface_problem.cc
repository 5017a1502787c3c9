#include "micro/equilibrium/interface_problem.h"

#include "micro/cohesive/node_response.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cstdio>

namespace spall {
namespace {

/// Augmentation of each node, Pa/m: the node's own stiffness, as in a Jacobi step, which makes the choice
/// between closed and open independent of units and mesh. At least twice the steepest softening, so that the
/// law's inverse is unique. It decides the path of the iterations only, never the result.
std::vector<double> augmentations(const InterfaceProblem& problem) {
  std::vector<double> values(problem.cell.nodes.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double stiffness =
        std::max(problem.cell.stiffness(2 * i, 2 * i), problem.cell.stiffness(2 * i + 1, 2 * i + 1));
    values[i] =
        std::max(problem.youngs_modulus * stiffness / (problem.cell.nodes[i].weight * problem.cell_size),
                 2 * problem.law.steepest_slope());
  }
  return values;
}

} // namespace

CellState unloaded_state(const InterfaceProblem& problem) {
  CellState state;
  state.opening = Eigen::VectorXd::Zero(problem.cell.stiffness.rows());
  for (const CrackNode& node : problem.cell.nodes)
    state.largest.push_back(node.initially_open ? problem.law.final_opening() : 0);
  return state;
}

std::string describe(const NewtonReport& report) {
  switch (report.outcome) {
  case NewtonReport::Outcome::converged:
    return "converged";
  case NewtonReport::Outcome::unstable:
    return "the tangent stiffness is not positive definite";
  case NewtonReport::Outcome::not_converged:
    break;
  }
  char text[120];
  std::snprintf(text, sizeof text, "Newton did not converge in %d iterations (traction error %.3g Pa)",
                report.iterations, report.traction_error);
  return text;
}

NewtonReport equilibrate(const InterfaceProblem& problem, const Voigt& strain, const Eigen::VectorXd& guess,
                         CellState& state) {
  const CondensedCell& cell = problem.cell;
  const double E = problem.youngs_modulus, l = problem.cell_size;
  const std::size_t n = cell.nodes.size();
  const std::vector<double> augmentation = augmentations(problem);
  const Eigen::VectorXd load = E * l * (cell.coupling * strain);

  Eigen::VectorXd w = guess, change(2 * n), driving(2 * n);
  std::vector<NodeResponse> responses(n);
  std::vector<Eigen::Index> free;
  NewtonReport report;
  for (;; ++report.iterations) {
    // Force with which the bulk pulls the faces open; p = T + augmentation * w at each node.
    const Eigen::VectorXd pull = load - E * (cell.stiffness * w);
    report.traction_error = 0;
    free.clear();
    for (std::size_t i = 0; i < n; ++i) {
      const double length = cell.nodes[i].weight * l;
      const Eigen::Vector2d here = w.segment<2>(2 * i);
      responses[i] = node_response(problem.law, augmentation[i], state.largest[i],
                                   pull.segment<2>(2 * i) / length + augmentation[i] * here);
      const Eigen::Vector2d defect = responses[i].opening - here;
      report.traction_error = std::max(report.traction_error, augmentation[i] * defect.norm());
      change.segment<2>(2 * i) = defect;
      driving.segment<2>(2 * i) = length * (responses[i].tangent * defect + augmentation[i] * defect);
      for (int c = 0; c < 2; ++c)
        if (responses[i].free[c]) free.push_back(static_cast<Eigen::Index>(2 * i + c));
    }
    // Held components move straight to zero opening, the free ones follow from the symmetric tangent. It is
    // factorised at the converged state too: that is the check of stability.
    Eigen::MatrixXd tangent = E * cell.stiffness(free, free);
    for (std::size_t a = 0; a < free.size(); ++a)
      for (std::size_t b = a > 0 ? a - 1 : 0; b < std::min(a + 2, free.size()); ++b)
        if (const auto node = free[a] / 2; node == free[b] / 2)
          tangent(a, b) += cell.nodes[node].weight * l * responses[node].tangent(free[a] % 2, free[b] % 2);
    const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factor(tangent); // in place
    if (!free.empty() && factor.info() != Eigen::Success) {
      report.outcome = NewtonReport::Outcome::unstable;
      return report;
    }
    const bool converged = report.traction_error <= problem.newton.tolerance * problem.law.strength();
    if (!converged && report.iterations == problem.newton.max_iterations) return report;
    Eigen::VectorXd held = change;
    held(free).setZero();
    const Eigen::VectorXd right = (driving - E * (cell.stiffness * held))(free);
    change(free) = Eigen::VectorXd(factor.solve(right));
    w += change; // after convergence too: the factor is there, and the step takes the error to round-off
    if (converged) break;
  }
  report.outcome = NewtonReport::Outcome::converged;
  state.strain = strain;
  state.opening = w;
  for (std::size_t i = 0; i < n; ++i)
    state.largest[i] = std::max(state.largest[i], w.segment<2>(2 * i).norm());
  return report;
}

} // namespace spall
