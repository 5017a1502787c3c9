#include "micro/equilibrium/linearisation.h"

#include <algorithm>
#include <limits>

namespace spall {
namespace {

/// Estimated round-off error of an augmented traction, which is a sum over all openings, in units of its
/// relative machine precision. It matters for small elements, whose augmentations are large.
constexpr double round_offs = 64;

/// Returns the augmentation of each node, Pa/m: the node's own stiffness, as in a Jacobi step, so that the
/// choice between closed and open does not depend on units and mesh. It is at least twice the steepest
/// softening, so that the law's inverse is unique. It affects only the iterations, not the result.
template<int dim> std::vector<double> augmentations(const InterfaceProblem<dim>& problem) {
  std::vector<double> values(problem.cell.nodes.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double stiffness = problem.cell.stiffness.diagonal().template segment<dim>(dim * i).maxCoeff();
    values[i] =
        std::max(problem.youngs_modulus * stiffness / (problem.cell.nodes[i].weight * problem.cell_size),
                 2 * problem.law_at(i).steepest_slope());
  }
  return values;
}

} // namespace

template<int dim>
Linearisation<dim>::Linearisation(const InterfaceProblem<dim>& problem_, const CellState<dim>& state)
    : responses(problem_.cell.nodes.size()), defect(dim * problem_.cell.nodes.size()), problem(problem_),
      start(state), augmentation(augmentations(problem_)), driving(dim * problem_.cell.nodes.size()),
      normal_traction(problem_.cell.nodes.size()) {}

template<int dim> void Linearisation<dim>::update(const Eigen::VectorXd& load, const Eigen::VectorXd& w) {
  // The bulk pulls the faces open with the force `pull`; the augmented traction is p = T + augmentation * w.
  const Eigen::VectorXd pull = load - problem.youngs_modulus * (problem.cell.stiffness * w);
  const double tangential = problem.mode.traction_weight();
  traction_error = round_off = 0;
  free.clear();
  for (std::size_t i = 0; i < responses.size(); ++i) {
    const double area = problem.cell.nodes[i].weight * problem.cell_size, a = augmentation[i];
    Opening<dim> factor = Opening<dim>::Constant(tangential * a);
    factor[0] = a;
    const Opening<dim> here = w.segment<dim>(dim * i);
    const Opening<dim> augmented = pull.segment<dim>(dim * i) / area + factor.cwiseProduct(here);
    normal_traction[i] = augmented[0];
    round_off = std::max(round_off, round_offs * std::numeric_limits<double>::epsilon() * augmented.norm());
    NodeHistory<dim> history{.largest = start.largest[i]};
    if (problem.mode.friction > 0) history.slip = start.opening.template segment<dim - 1>(dim * i + 1);
    responses[i] = node_response<dim>(problem.law_at(i), problem.mode, a, history, augmented);
    const Opening<dim> miss = responses[i].opening - here;
    traction_error = std::max(traction_error, factor.cwiseProduct(miss).norm());
    defect.segment<dim>(dim * i) = miss;
    driving.segment<dim>(dim * i) = area * (responses[i].tangent * miss + factor.cwiseProduct(miss));
    driving.segment<dim - 1>(dim * i + 1) += area * a * miss[0] * responses[i].friction;
    for (int c = 0; c < dim; ++c)
      if (responses[i].free[c]) free.push_back(static_cast<Eigen::Index>(dim * i + c));
  }
}

template<int dim> Eigen::MatrixXd Linearisation<dim>::tangent() const {
  const double E = problem.youngs_modulus;
  Eigen::MatrixXd matrix = E * problem.cell.stiffness(free, free);
  for (std::size_t a = 0; a < free.size(); ++a) {
    const auto node = free[a] / dim, component = free[a] % dim;
    for (std::size_t b = a >= dim ? a - dim + 1 : 0; b < std::min(a + dim, free.size()); ++b)
      if (node == free[b] / dim)
        matrix(a, b) += problem.cell.nodes[node].weight * problem.cell_size *
                        responses[node].tangent(component, free[b] % dim);
    // Friction grows with the contact pressure, which depends on all openings through the bulk.
    if (const double friction = component > 0 ? responses[node].friction[component - 1] : 0; friction != 0)
      for (std::size_t b = 0; b < free.size(); ++b)
        matrix(a, b) += friction * E * problem.cell.stiffness(dim * node, free[b]);
  }
  return matrix;
}

template<int dim> Eigen::VectorXd Linearisation<dim>::areas() const {
  Eigen::VectorXd result(free.size());
  for (std::size_t a = 0; a < free.size(); ++a)
    result[a] = problem.cell.nodes[free[a] / dim].weight * problem.cell_size;
  return result;
}

template<int dim> Eigen::VectorXd Linearisation<dim>::rows(const Eigen::VectorXd& force) const {
  Eigen::VectorXd result = force(free);
  for (std::size_t a = 0; a < free.size(); ++a)
    if (const auto node = free[a] / dim, component = free[a] % dim; component > 0)
      result[a] += responses[node].friction[component - 1] * force[dim * node];
  return result;
}

template<int dim> Eigen::VectorXd Linearisation<dim>::right_side() const {
  Eigen::VectorXd held = defect;
  held(free).setZero();
  const Eigen::VectorXd resisted = problem.youngs_modulus * (problem.cell.stiffness * held);
  return driving(free) - rows(resisted);
}

template<int dim> Eigen::VectorXd Linearisation<dim>::change(const Eigen::VectorXd& step) const {
  Eigen::VectorXd all = defect;
  all(free) = step;
  return all;
}

template<int dim> LinearMeasure Linearisation<dim>::damage(const CellState<dim>& before) const {
  LinearMeasure measure;
  measure.derivative = Eigen::VectorXd::Zero(dim * responses.size());
  const double g = problem.mode.opening_weight();
  for (std::size_t i = 0; i < responses.size(); ++i) {
    if (problem.cell.nodes[i].initially_open) continue;
    const CohesiveLaw& law = problem.law_at(i);
    const double weight = problem.cell.nodes[i].weight / problem.cell_size;
    const Opening<dim>& w = responses[i].opening;
    const double opening = problem.mode.template effective<dim>(w);
    measure.value += weight * law.dissipation(std::max(before.largest[i], opening));
    if (!responses[i].loading || opening <= 0) continue;
    Opening<dim> along = g * g * w;
    along[0] = w[0];
    measure.derivative.segment<dim>(dim * i) = weight * law.dissipation_slope(opening) * along / opening;
  }
  return measure;
}

template<int dim> double Linearisation<dim>::pressure(std::size_t node) const {
  return std::max(0.0, -normal_traction[node]);
}

template class Linearisation<2>;
template class Linearisation<3>;

} // namespace spall
