#include "micro/equilibrium/interface_problem.h"

#include "micro/equilibrium/linearisation.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace spall {
namespace {

/// Stiffness below which a mode counts as neutral, relative to that of a node.
constexpr double neutral_stiffness = 1e-11;

/// Takes converged openings over into the state, with what friction and the law dissipated on the way.
void accept(const InterfaceProblem& problem, const Linearisation& linear, const Voigt& strain,
            const Eigen::VectorXd& w, CellState& state) {
  for (std::size_t i = 0; i < state.largest.size(); ++i) {
    const Eigen::Vector2d here = w.segment<2>(2 * i);
    const double length = problem.cell.nodes[i].weight, before = state.largest[i];
    state.largest[i] = std::max(before, problem.mode.effective(here));
    if (problem.mode.energy_ratio != 1 && state.largest[i] > before &&
        !problem.cell.nodes[i].initially_open) {
      // Exact where normal and tangential opening grow in proportion.
      const double share = problem.mode.stored(here) / (state.largest[i] * state.largest[i]);
      const CohesiveLaw& law = problem.law_at(i);
      state.dissipated[i] += share * (law.dissipation(state.largest[i]) - law.dissipation(before));
    }
    if (linear.responses[i].friction != 0)
      state.friction_work += length / problem.cell_size * problem.mode.friction * linear.pressure(i) *
                             std::abs(here[1] - state.opening[2 * i + 1]);
  }
  state.strain = strain;
  state.opening = w;
}

} // namespace

CellState unloaded_state(const InterfaceProblem& problem) {
  CellState state;
  state.opening = Eigen::VectorXd::Zero(problem.cell.stiffness.rows());
  for (std::size_t i = 0; i < problem.cell.nodes.size(); ++i)
    state.largest.push_back(problem.cell.nodes[i].initially_open ? problem.law_at(i).final_opening() : 0);
  state.dissipated.assign(state.largest.size(), 0);
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
  const Eigen::VectorXd load = problem.youngs_modulus * problem.cell_size * (problem.cell.coupling * strain);
  Linearisation linear(problem, state);
  Eigen::VectorXd w = guess;
  NewtonReport report;
  for (;; ++report.iterations) {
    linear.update(load, w);
    report.traction_error = linear.traction_error;
    // Held components move straight to where they are held, the free ones follow from the tangent. It is
    // factorised at the converged state too: that is the check of stability.
    const bool converged = report.traction_error <=
                           std::max(problem.newton.tolerance * problem.law.strength(), linear.round_off);
    Eigen::MatrixXd tangent = linear.tangent();
    Eigen::VectorXd step;
    const auto solve = [&](const auto& factor, bool stable) {
      if (!stable) return false;
      if (converged || report.iterations < problem.newton.max_iterations)
        step = factor.solve(linear.right_side());
      return true;
    };
    bool stable = true;
    if (problem.mode.symmetric()) {
      Eigen::LLT<Eigen::MatrixXd> factor(tangent);
      if (factor.info() != Eigen::Success && !linear.free.empty()) {
        // Separated parts of a cell whose strain is partly free move without a force: neutral, not unstable.
        tangent.diagonal() *= 1 + neutral_stiffness;
        factor.compute(tangent);
      }
      stable = solve(factor, linear.free.empty() || factor.info() == Eigen::Success);
    } else {
      const Eigen::PartialPivLU<Eigen::Ref<Eigen::MatrixXd>> factor(tangent);
      const auto negative = (factor.matrixLU().diagonal().array() < 0).count();
      stable = solve(factor, factor.permutationP().determinant() * (negative % 2 == 0 ? 1 : -1) > 0);
    }
    if (!stable) {
      report.outcome = NewtonReport::Outcome::unstable;
      return report;
    }
    if (!converged && report.iterations == problem.newton.max_iterations) return report;
    w += linear.change(step); // after convergence too: the step takes the error to round-off
    if (converged) break;
  }
  report.outcome = NewtonReport::Outcome::converged;
  accept(problem, linear, strain, w, state);
  return report;
}

NewtonReport equilibrate_damage(const InterfaceProblem& problem, const Voigt& direction, double measure,
                                const CellState& guess, CellState& state) {
  const double E = problem.youngs_modulus, l = problem.cell_size;
  // The load unknown is a length, strain times edge, so that all columns are stiffnesses.
  const Eigen::VectorXd unit_load = E * (problem.cell.coupling * direction);
  double load = guess.strain.dot(direction) / direction.squaredNorm() * l;
  Eigen::VectorXd w = guess.opening;
  Linearisation linear(problem, state);
  NewtonReport report;
  for (;; ++report.iterations) {
    linear.update(load * unit_load, w);
    const LinearMeasure damage = linear.damage(state);
    report.traction_error = linear.traction_error;
    const bool converged =
        report.traction_error <=
            std::max(problem.newton.tolerance * problem.law.strength(), linear.round_off) &&
        std::abs(damage.value - measure) <= 1e-9 * measure;
    if (!converged && report.iterations == problem.newton.max_iterations) return report;
    const Eigen::Index n = static_cast<Eigen::Index>(linear.free.size());
    const Eigen::VectorXd gradient = damage.gradient(linear.free);
    const double largest = n > 0 ? gradient.cwiseAbs().maxCoeff() : 0;
    if (!(largest > 0)) return report; // nothing is being damaged: the load is not determined
    const double scale = E / largest;  // of the constraint's row
    Eigen::MatrixXd bordered(n + 1, n + 1);
    bordered.topLeftCorner(n, n) = linear.tangent();
    bordered.topRightCorner(n, 1) = -linear.rows(unit_load);
    bordered.bottomLeftCorner(1, n) = scale * gradient.transpose();
    bordered(n, n) = 0;
    Eigen::VectorXd right(n + 1);
    right.head(n) = linear.right_side();
    right[n] = scale * (measure - damage.value + gradient.dot(linear.defect(linear.free)));
    const Eigen::VectorXd step = Eigen::PartialPivLU<Eigen::Ref<Eigen::MatrixXd>>(bordered).solve(right);
    if (!step.allFinite()) return report;
    w += linear.change(step.head(n));
    load += step[n];
    if (converged) break;
  }
  report.outcome = NewtonReport::Outcome::converged;
  accept(problem, linear, load / l * direction, w, state);
  return report;
}

double damage_measure(const InterfaceProblem& problem, const CellState& state) {
  double sum = 0;
  for (std::size_t i = 0; i < state.largest.size(); ++i)
    if (!problem.cell.nodes[i].initially_open)
      sum += problem.cell.nodes[i].weight * problem.law_at(i).dissipation(state.largest[i]);
  return sum / problem.cell_size;
}

} // namespace spall
