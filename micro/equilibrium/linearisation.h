#pragma once

#include "micro/cohesive/node_response.h"
#include "micro/equilibrium/interface_problem.h"

namespace spall {

/// damage_measure() and its derivative with respect to the openings, at the openings that the law returns for
/// the augmented tractions.
struct LinearMeasure {
  double value = 0;
  Eigen::VectorXd derivative; ///< derivative with respect to all openings, dim per node
  Eigen::VectorXd gradient(const std::vector<Eigen::Index>& free) const { return derivative(free); }
};

/// The equilibrium equations of the crack lines, linearised at openings `w`. The law returns for the
/// augmented traction of each node an opening; the equations are solved when these openings agree with `w`,
/// and the free components have to change until they do. The equations are forces in the units of
/// CondensedCell, N/m.
template<int dim> class Linearisation {
public:
  /// @param state the state at the beginning of the step. Both arguments must outlive this object.
  Linearisation(const InterfaceProblem<dim>& problem, const CellState<dim>& state);

  /// Evaluates all members below. @param load forces of the macroscopic strain, dim per node, N/m
  void update(const Eigen::VectorXd& load, const Eigen::VectorXd& w);

  std::vector<NodeResponse<dim>> responses;
  std::vector<Eigen::Index> free; ///< numbers of the components that may change
  Eigen::VectorXd defect;         ///< opening that the law returns minus the present one, m
  double traction_error = 0;      ///< largest traction error over the nodes, Pa
  double round_off = 0;           ///< part of traction_error that may be round-off, Pa

  Eigen::MatrixXd tangent() const; ///< tangent stiffness of the free components
  /// Crack areas that belong to the free components, in the units of the forces, m.
  Eigen::VectorXd areas() const;
  Eigen::VectorXd right_side() const; ///< right-hand side of the free components, N/m
  /// Returns the contribution of a force on all components to the equations of the free components.
  Eigen::VectorXd rows(const Eigen::VectorXd& force) const;
  /// Returns the change of all openings when the free components change by `step`.
  Eigen::VectorXd change(const Eigen::VectorXd& step) const;
  LinearMeasure damage(const CellState<dim>& before) const;
  double pressure(std::size_t node) const; ///< contact pressure between the faces, Pa, >= 0

private:
  const InterfaceProblem<dim>& problem;
  const CellState<dim>& start;
  std::vector<double> augmentation; ///< augmentation of each node, Pa/m
  Eigen::VectorXd driving;
  std::vector<double> normal_traction; ///< augmented normal traction of each node, Pa
};

} // namespace spall
