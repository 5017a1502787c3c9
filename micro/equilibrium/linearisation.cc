#include "micro/equilibrium/linearisation.h"

#include <algorithm>
#include <limits>

namespace spall {
namespace {

/// Error of an augmented traction, a sum over all openings, in units of its last digit. Small elements have
/// large augmentations.
constexpr double round_offs = 64;

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
                 2 * problem.law_at(i).steepest_slope());
  }
  return values;
}

} // namespace

Linearisation::Linearisation(const InterfaceProblem& problem_, const CellState& state)
    : responses(problem_.cell.nodes.size()), defect(2 * problem_.cell.nodes.size()), problem(problem_),
      start(state), augmentation(augmentations(problem_)), driving(2 * problem_.cell.nodes.size()),
      normal_traction(problem_.cell.nodes.size()) {}

void Linearisation::update(const Eigen::VectorXd& load, const Eigen::VectorXd& w) {
  // Force with which the bulk pulls the faces open; p = T + augmentation * w at each node.
  const Eigen::VectorXd pull = load - problem.youngs_modulus * (problem.cell.stiffness * w);
  const double tangential = problem.mode.traction_weight();
  traction_error = round_off = 0;
  free.clear();
  for (std::size_t i = 0; i < responses.size(); ++i) {
    const double length = problem.cell.nodes[i].weight * problem.cell_size, a = augmentation[i];
    const Eigen::Vector2d here = w.segment<2>(2 * i), factor(a, tangential * a);
    const Eigen::Vector2d augmented = pull.segment<2>(2 * i) / length + factor.cwiseProduct(here);
    normal_traction[i] = augmented[0];
    round_off = std::max(round_off, round_offs * std::numeric_limits<double>::epsilon() * augmented.norm());
    const double slip = problem.mode.friction > 0 ? start.opening[2 * i + 1] : 0;
    responses[i] = node_response(problem.law_at(i), problem.mode, a,
                                 {.largest = start.largest[i], .slip = slip}, augmented);
    const Eigen::Vector2d miss = responses[i].opening - here;
    traction_error = std::max(traction_error, factor.cwiseProduct(miss).norm());
    defect.segment<2>(2 * i) = miss;
    driving.segment<2>(2 * i) = length * (responses[i].tangent * miss + factor.cwiseProduct(miss));
    driving[2 * i + 1] += length * a * responses[i].friction * miss[0];
    for (int c = 0; c < 2; ++c)
      if (responses[i].free[c]) free.push_back(static_cast<Eigen::Index>(2 * i + c));
  }
}

Eigen::MatrixXd Linearisation::tangent() const {
  const double E = problem.youngs_modulus;
  Eigen::MatrixXd matrix = E * problem.cell.stiffness(free, free);
  for (std::size_t a = 0; a < free.size(); ++a) {
    const auto node = free[a] / 2;
    for (std::size_t b = a > 0 ? a - 1 : 0; b < std::min(a + 2, free.size()); ++b)
      if (node == free[b] / 2)
        matrix(a, b) += problem.cell.nodes[node].weight * problem.cell_size *
                        responses[node].tangent(free[a] % 2, free[b] % 2);
    // Friction grows with the pressure, which the bulk answers for.
    if (free[a] % 2 == 1 && responses[node].friction != 0)
      for (std::size_t b = 0; b < free.size(); ++b)
        matrix(a, b) += responses[node].friction * E * problem.cell.stiffness(2 * node, free[b]);
  }
  return matrix;
}

Eigen::VectorXd Linearisation::rows(const Eigen::VectorXd& force) const {
  Eigen::VectorXd result = force(free);
  for (std::size_t a = 0; a < free.size(); ++a)
    if (const auto node = free[a] / 2; free[a] % 2 == 1 && responses[node].friction != 0)
      result[a] += responses[node].friction * force[2 * node];
  return result;
}

Eigen::VectorXd Linearisation::right_side() const {
  Eigen::VectorXd held = defect;
  held(free).setZero();
  const Eigen::VectorXd resisted = problem.youngs_modulus * (problem.cell.stiffness * held);
  return driving(free) - rows(resisted);
}

Eigen::VectorXd Linearisation::change(const Eigen::VectorXd& step) const {
  Eigen::VectorXd all = defect;
  all(free) = step;
  return all;
}

LinearMeasure Linearisation::damage(const CellState& before) const {
  LinearMeasure measure;
  measure.derivative = Eigen::VectorXd::Zero(2 * responses.size());
  const double g = problem.mode.opening_weight();
  for (std::size_t i = 0; i < responses.size(); ++i) {
    if (problem.cell.nodes[i].initially_open) continue;
    const CohesiveLaw& law = problem.law_at(i);
    const double weight = problem.cell.nodes[i].weight / problem.cell_size;
    const Eigen::Vector2d w = responses[i].opening;
    const double opening = problem.mode.effective(w);
    measure.value += weight * law.dissipation(std::max(before.largest[i], opening));
    if (!responses[i].loading || opening <= 0) continue;
    measure.derivative.segment<2>(2 * i) =
        weight * law.dissipation_slope(opening) * Eigen::Vector2d(w[0], g * g * w[1]) / opening;
  }
  return measure;
}

double Linearisation::pressure(std::size_t node) const { return std::max(0.0, -normal_traction[node]); }

} // namespace spall
