#include "micro/homogenization/energies.h"

#include "micro/cohesive/node_response.h"

#include <algorithm>

namespace spall {

template<int dim>
HomogenizedState<dim> homogenize(const InterfaceProblem<dim>& problem, const CellState<dim>& state) {
  const CondensedCell<dim>& cell = problem.cell;
  const double E = problem.youngs_modulus, l = problem.cell_size;
  const Eigen::VectorXd w = state.opening / l; // openings of the unit cell
  const Voigt<dim> uncracked_stress = E * (cell.uncracked * state.strain);

  HomogenizedState<dim> result;
  result.stress = uncracked_stress - E * (cell.coupling.transpose() * w);
  result.psi_undamaged = 0.5 * state.strain.dot(uncracked_stress);
  result.psi_bulk =
      result.psi_undamaged + E * w.dot(0.5 * (cell.stiffness * w) - cell.coupling * state.strain);
  for (std::size_t i = 0; i < cell.nodes.size(); ++i) {
    const Opening<dim> here = state.opening.template segment<dim>(dim * i);
    const double opening = here.norm();
    result.opening = std::max(result.opening, opening);
    if (cell.nodes[i].initially_open || state.largest[i] <= 0) continue;
    const CohesiveLaw& law = problem.law_at(i);
    const double weight = cell.nodes[i].weight / l; // area of the crack / volume of the cell
    const double square =
        problem.mode.traction_weight() == 1 ? opening * opening : problem.mode.template stored<dim>(here);
    result.psi_cohesive += weight * 0.5 * secant_stiffness(law, state.largest[i]) * square;
    result.dissipation +=
        weight * (problem.mode.energy_ratio == 1 ? law.dissipation(state.largest[i]) : state.dissipated[i]);
  }
  result.dissipation += state.friction_work;
  return result;
}

template HomogenizedState<2> homogenize(const InterfaceProblem<2>&, const CellState<2>&);
template HomogenizedState<3> homogenize(const InterfaceProblem<3>&, const CellState<3>&);

} // namespace spall
