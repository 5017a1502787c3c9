#include "micro/equilibrium/interface_problem.h"

#include "micro/equilibrium/linearisation.h"
#include "micro/equilibrium/stability.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace spall {
namespace {

/// Relative increase of the tangent's diagonal that regularises modes without stiffness.
constexpr double neutral_stiffness = 1e-11;

/// Stores converged openings in the state and adds the energies that friction and the law dissipated in the
/// step.
template<int dim>
void accept(const InterfaceProblem<dim>& problem, const Linearisation<dim>& linear, const Voigt<dim>& strain,
            const Eigen::VectorXd& w, CellState<dim>& state) {
  for (std::size_t i = 0; i < state.largest.size(); ++i) {
    const Opening<dim> here = w.segment<dim>(dim * i);
    const double weight = problem.cell.nodes[i].weight, before = state.largest[i];
    state.largest[i] = std::max(before, problem.mode.effective(here));
    if (problem.mode.energy_ratio != 1 && state.largest[i] > before &&
        !problem.cell.nodes[i].initially_open) {
      // Exact where normal and tangential opening grow in proportion.
      const double share = problem.mode.stored(here) / (state.largest[i] * state.largest[i]);
      const CohesiveLaw& law = problem.law_at(i);
      state.dissipated[i] += share * (law.dissipation(state.largest[i]) - law.dissipation(before));
    }
    if (!linear.responses[i].friction.isZero(0)) {
      const Slip<dim> slip =
          here.template tail<dim - 1>() - state.opening.template segment<dim - 1>(dim * i + 1);
      state.friction_work +=
          weight / problem.cell_size * linear.pressure(i) * std::abs(linear.responses[i].friction.dot(slip));
    }
  }
  state.strain = strain;
  state.opening = w;
}

/// Returns whether a tangent that is not symmetric has an eigenvalue with a negative real part. All
/// eigenvalues are computed only if the symmetric part is not positive definite.
bool has_growing_disturbance(const Eigen::MatrixXd& tangent, const Eigen::VectorXd& areas) {
  if (tangent.size() == 0) return false;
  const Eigen::LLT<Eigen::MatrixXd> symmetric(0.5 * (tangent + tangent.transpose()));
  return symmetric.info() != Eigen::Success && growing_disturbances(tangent, areas) > 0;
}

} // namespace

template<int dim> CellState<dim> unloaded_state(const InterfaceProblem<dim>& problem) {
  CellState<dim> state;
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

template<int dim>
NewtonReport equilibrate(const InterfaceProblem<dim>& problem, const Voigt<dim>& strain,
                         const Eigen::VectorXd& guess, CellState<dim>& state) {
  const Eigen::VectorXd load = problem.youngs_modulus * problem.cell_size * (problem.cell.coupling * strain);
  Linearisation<dim> linear(problem, state);
  Eigen::VectorXd w = guess;
  NewtonReport report;
  for (;; ++report.iterations) {
    linear.update(load, w);
    report.traction_error = linear.traction_error;
    // Held components get their values directly, the free ones follow from the tangent stiffness. The tangent
    // is factorised at the converged state too, which is the check of stability.
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
        // Separated parts of a cell with free strain components can move without a force, which is no
        // instability.
        tangent.diagonal() *= 1 + neutral_stiffness;
        factor.compute(tangent);
      }
      stable = solve(factor, linear.free.empty() || factor.info() == Eigen::Success);
    } else {
      stable = !converged || !has_growing_disturbance(tangent, linear.areas());
      const Eigen::PartialPivLU<Eigen::Ref<Eigen::MatrixXd>> factor(tangent);
      stable = solve(factor, stable);
    }
    if (!stable) {
      report.outcome = NewtonReport::Outcome::unstable;
      return report;
    }
    if (!converged && report.iterations == problem.newton.max_iterations) return report;
    w += linear.change(step); // after convergence too, as this step reduces the error to round-off
    if (converged) break;
  }
  report.outcome = NewtonReport::Outcome::converged;
  accept(problem, linear, strain, w, state);
  return report;
}

template<int dim>
NewtonReport equilibrate_damage(const InterfaceProblem<dim>& problem, double measure,
                                const CellState<dim>& guess, CellState<dim>& state) {
  const Voigt<dim>& direction = problem.direction;
  const double E = problem.youngs_modulus, l = problem.cell_size;
  // The unknown load is a length, strain times edge, so that all columns have the unit of a stiffness.
  const Eigen::VectorXd unit_load = E * (problem.cell.coupling * direction);
  double load = guess.strain.dot(direction) / direction.squaredNorm() * l;
  Eigen::VectorXd w = guess.opening;
  Linearisation<dim> linear(problem, state);
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
    if (!(largest > 0)) return report; // no node is being damaged, so the load is not determined
    const double scale = E / largest;  // scale of the constraint's row
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
  accept<dim>(problem, linear, load / l * direction, w, state);
  return report;
}

template<int dim> double damage_measure(const InterfaceProblem<dim>& problem, const CellState<dim>& state) {
  double sum = 0;
  for (std::size_t i = 0; i < state.largest.size(); ++i)
    if (!problem.cell.nodes[i].initially_open)
      sum += problem.cell.nodes[i].weight * problem.law_at(i).dissipation(state.largest[i]);
  return sum / problem.cell_size;
}

#define SPALL_INSTANTIATE(dim)                                                                               \
  template CellState<dim> unloaded_state(const InterfaceProblem<dim>&);                                      \
  template NewtonReport equilibrate(const InterfaceProblem<dim>&, const Voigt<dim>&, const Eigen::VectorXd&, \
                                    CellState<dim>&);                                                        \
  template NewtonReport equilibrate_damage(const InterfaceProblem<dim>&, double, const CellState<dim>&,      \
                                           CellState<dim>&);                                                 \
  template double damage_measure(const InterfaceProblem<dim>&, const CellState<dim>&);
SPALL_INSTANTIATE(2)
SPALL_INSTANTIATE(3)
#undef SPALL_INSTANTIATE

} // namespace spall
