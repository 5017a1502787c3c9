#include "micro/homogenization/damage.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace spall {

double initial_damage(const CondensedCell& cell, int pull) {
  std::vector<Eigen::Index> open;
  for (std::size_t i = 0; i < cell.nodes.size(); ++i)
    if (cell.nodes[i].initially_open)
      for (int c = 0; c < 2; ++c) open.push_back(static_cast<Eigen::Index>(2 * i + c));
  if (open.empty()) return 0;
  const Eigen::MatrixXd stiffness = cell.stiffness(open, open);
  const Eigen::VectorXd coupling = cell.coupling.col(pull)(open);
  return coupling.dot(stiffness.llt().solve(coupling)) / cell.uncracked(pull, pull);
}

void append_row(DamageCurve& curve, const InterfaceProblem& problem, const CellState& state, int pull) {
  const HomogenizedState now = homogenize(problem, state);
  const double strain = state.strain[pull], stress = now.stress[pull];
  const bool first = curve.strain.empty();
  // The unloaded cell has no energies to compare: its damage is the limit of small strain.
  const double damage = first ? initial_damage(problem.cell, pull) : 1 - now.psi() / now.psi_undamaged;
  const double path =
      first ? damage : 1 - (now.psi() - curve.psi.back()) / (now.psi_undamaged - curve.psi_undamaged.back());
  const double work =
      first ? 0 : curve.work.back() + 0.5 * (stress + curve.stress.back()) * (strain - curve.strain.back());

  curve.strain.push_back(strain);
  curve.stress.push_back(stress);
  curve.psi_bulk.push_back(now.psi_bulk);
  curve.psi_cohesive.push_back(now.psi_cohesive);
  curve.psi.push_back(now.psi());
  curve.psi_undamaged.push_back(now.psi_undamaged);
  curve.damage.push_back(damage);
  curve.damage_path.push_back(path);
  curve.damage_renormalised.push_back(first ? 0 : 1 - (1 - damage) / (1 - curve.damage.front()));
  curve.opening.push_back(now.opening);
  curve.dissipation.push_back(now.dissipation);
  curve.work.push_back(work);
}

void set_strength_damage(DamageCurve& curve, double zero) {
  curve.damage_strength.assign(curve.stress.size(), 0);
  const auto peak = std::max_element(curve.stress.begin(), curve.stress.end());
  if (!(*peak > 0)) return;
  for (auto stress = peak; stress != curve.stress.end(); ++stress)
    curve.damage_strength[stress - curve.stress.begin()] =
        std::abs(*stress) <= zero * *peak ? 1 : 1 - *stress / *peak;
}

EnergyChecks check_energies(const DamageCurve& curve) {
  EnergyChecks checks;
  for (std::size_t i = 0; i < curve.strain.size(); ++i) {
    checks.stress = std::max(checks.stress, std::abs(curve.psi[i] - 0.5 * curve.stress[i] * curve.strain[i]));
    checks.work = std::max(checks.work, std::abs(curve.work[i] - curve.dissipation[i] - curve.psi[i]));
  }
  const double scale = *std::max_element(curve.psi.begin(), curve.psi.end());
  if (scale > 0) checks = {checks.stress / scale, checks.work / scale};
  return checks;
}

} // namespace spall
