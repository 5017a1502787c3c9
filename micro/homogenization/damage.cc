#include "micro/homogenization/damage.h"

#include "micro/equilibrium/isotropic.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <utility>

namespace spall {
namespace {

/// Width of the stress drop in an envelope where the path snaps back, as a fraction of the strain there.
constexpr double drop_width = 1e-6;

} // namespace

template<int dim> double initial_damage(const InterfaceProblem<dim>& problem) {
  const CondensedCell<dim>& cell = problem.cell;
  const Voigt<dim>& direction = problem.direction;
  std::vector<Eigen::Index> open;
  for (std::size_t i = 0; i < cell.nodes.size(); ++i)
    if (cell.nodes[i].initially_open)
      for (int c = 0; c < dim; ++c) open.push_back(static_cast<Eigen::Index>(dim * i + c));
  if (open.empty()) return 0;
  const Eigen::MatrixXd stiffness = cell.stiffness(open, open);
  const Eigen::VectorXd coupling = (cell.coupling * direction)(open);
  const double undamaged = direction.dot(cell.uncracked * direction);
  const Eigen::VectorXd relaxed = stiffness.llt().solve(coupling);
  bool pressed = false;
  for (Eigen::Index i = 0; i < relaxed.size(); i += dim) pressed = pressed || relaxed[i] < 0;
  if (!pressed) return coupling.dot(relaxed) / undamaged;
  // With contact the response depends on the sign of the strain but scales with its size, so that a strain
  // far below the strength gives the limit of small strain.
  const Voigt<dim> strain = 1e-6 * problem.law.strength() / problem.youngs_modulus * direction;
  CellState<dim> state = unloaded_state(problem);
  if (equilibrate(problem, strain, Eigen::VectorXd(state.opening), state).outcome !=
      NewtonReport::Outcome::converged)
    return coupling.dot(relaxed) / undamaged;
  const HomogenizedState<dim> now = homogenize(problem, state);
  return 1 - now.psi() / now.psi_undamaged;
}

template<int dim> SplitEnergy spectral_split(const Voigt<dim>& strain, double poisson_ratio) {
  const Isotropic elastic(poisson_ratio);
  Eigen::Matrix<double, dim, dim> tensor;
  for (int i = 0; i < voigt_size<dim>; ++i) {
    const auto [row, column] = tensor_index<dim>(i);
    tensor(row, column) = tensor(column, row) = row == column ? strain[i] : 0.5 * strain[i];
  }
  SplitEnergy energy; // in plane strain the third principal strain is 0 and contributes nothing
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, dim, dim>> principal(tensor,
                                                                                 Eigen::EigenvaluesOnly);
  for (const double value : principal.eigenvalues())
    (value > 0 ? energy.plus : energy.minus) += elastic.mu * value * value;
  const double volume = tensor.trace();
  (volume > 0 ? energy.plus : energy.minus) += 0.5 * elastic.lambda * volume * volume;
  return energy;
}

double damage_plus(double psi, const SplitEnergy& undamaged) {
  return undamaged.plus > 0 ? 1 - (psi - undamaged.minus) / undamaged.plus : 0;
}

void set_damage_plus(DamageCurve& curve, const SplitEnergy& unit) {
  for (std::size_t i = 0; i < curve.strain.size(); ++i) {
    const double square = curve.strain[i] * curve.strain[i];
    SplitEnergy now{square * unit.plus, square * unit.minus};
    if (curve.strain[i] < 0) std::swap(now.plus, now.minus);
    curve.psi_undamaged_plus.push_back(now.plus);
    curve.psi_undamaged_minus.push_back(now.minus);
    const double limit =
        unit.plus > 0 ? damage_plus((1 - curve.damage[i]) * (unit.plus + unit.minus), unit) : 0;
    curve.damage_plus.push_back(square > 0 ? damage_plus(curve.psi[i], now) : limit);
  }
}

template<int dim>
void append_row(DamageCurve& curve, const InterfaceProblem<dim>& problem, const CellState<dim>& state) {
  const Voigt<dim>& direction = problem.direction;
  const HomogenizedState<dim> now = homogenize(problem, state);
  const double strain = state.strain.dot(direction) / direction.squaredNorm();
  const double stress = now.stress.dot(direction);
  const bool first = curve.strain.empty();
  // All energies of the unloaded cell are 0, so its damage is the limit of small strain. (A later row at
  // strain 0 takes the damage of the previous row.)
  const double damage = first                   ? initial_damage(problem)
                        : now.psi_undamaged > 0 ? 1 - now.psi() / now.psi_undamaged
                                                : curve.damage.back();
  const double change = first ? 0 : now.psi_undamaged - curve.psi_undamaged.back();
  const double path = change == 0 ? damage : 1 - (now.psi() - curve.psi.back()) / change;
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

DamageCurve envelope(const DamageCurve& curve) {
  DamageCurve result;
  result.cell_size = curve.cell_size;
  result.relative_strength = curve.relative_strength;
  result.psi_stress_error = curve.psi_stress_error;
  result.psi_work_error = curve.psi_work_error;
  const auto append = [&](std::size_t row,
                          double share) { // interpolates between row - 1 (share 0) and row (share 1)
    for (const DamageColumn& column : damage_columns) {
      const std::vector<double>& values = curve.*column.values;
      if (values.empty()) continue; // not filled yet
      (result.*column.values)
          .push_back(share == 1 ? values[row] : values[row - 1] + share * (values[row] - values[row - 1]));
    }
  };
  bool turned = false;
  for (std::size_t i = 0; i < curve.strain.size(); ++i) {
    const double last = result.strain.empty() ? -1 : result.strain.back();
    if (curve.strain[i] <= last) {
      turned = true;
      continue;
    }
    const double back = last * (1 + drop_width);
    if (turned && curve.strain[i] > back)
      append(i, (back - curve.strain[i - 1]) / (curve.strain[i] - curve.strain[i - 1]));
    turned = false;
    append(i, 1);
  }
  // Damage must not decrease in a table, but interpolation and the drop itself may make it do so slightly,
  // and jammed fragments raise the stress of a cell again.
  for (const auto column :
       {&DamageCurve::damage, &DamageCurve::damage_strength, &DamageCurve::damage_renormalised})
    for (std::size_t i = 1; i < result.strain.size(); ++i)
      (result.*column)[i] = std::max((result.*column)[i], (result.*column)[i - 1]);
  return result;
}

EnergyChecks check_energies(const DamageCurve& curve) {
  EnergyChecks checks;
  for (std::size_t i = 0; i < curve.strain.size(); ++i)
    checks.include(std::abs(curve.psi[i] - 0.5 * curve.stress[i] * curve.strain[i]),
                   std::abs(curve.work[i] - curve.dissipation[i] - curve.psi[i]));
  const double scale = *std::max_element(curve.psi.begin(), curve.psi.end());
  if (scale > 0) {
    checks.stress /= scale;
    checks.work /= scale;
  }
  return checks;
}

#define SPALL_INSTANTIATE(dim)                                                                               \
  template double initial_damage(const InterfaceProblem<dim>&);                                              \
  template void append_row(DamageCurve&, const InterfaceProblem<dim>&, const CellState<dim>&);               \
  template SplitEnergy spectral_split<dim>(const Voigt<dim>&, double);
SPALL_INSTANTIATE(2)
SPALL_INSTANTIATE(3)
#undef SPALL_INSTANTIATE

} // namespace spall
