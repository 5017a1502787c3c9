#pragma once

#include "micro/cohesive/node_response.h"
#include "micro/equilibrium/interface_problem.h"

namespace spall {

/// damage_measure() and its derivative with the openings, at the openings the law answers with.
struct LinearMeasure {
  double value = 0;
  Eigen::VectorXd derivative; ///< dim per node
  Eigen::VectorXd gradient(const std::vector<Eigen::Index>& free) const { return derivative(free); }
};

/// The equations of the crack lines, linearised at openings `w`: each node answers exactly to its augmented
/// traction, and the free components are to move so that answers and openings agree. Equations are forces as
/// CondensedCell counts them, N/m.
template<int dim> class Linearisation {
public:
  /// `state` is where the step started. Both must outlive this.
  Linearisation(const InterfaceProblem<dim>& problem, const CellState<dim>& state);

  /// Evaluates everything below for forces `load` (dim per node, N/m) of the macroscopic strain.
  void update(const Eigen::VectorXd& load, const Eigen::VectorXd& w);

  std::vector<NodeResponse<dim>> responses;
  std::vector<Eigen::Index> free; ///< components that move
  Eigen::VectorXd defect;         ///< answered minus present opening
  double traction_error = 0;      ///< largest over the nodes, Pa
  double round_off = 0;           ///< what of it may be round-off, Pa

  Eigen::MatrixXd tangent() const;    ///< on the free components
  Eigen::VectorXd areas() const;      ///< that the free components stand for, as forces are counted, m
  Eigen::VectorXd right_side() const; ///< on the free components
  /// Rows of the equations of a force on all components.
  Eigen::VectorXd rows(const Eigen::VectorXd& force) const;
  /// Change of all openings when the free ones change by `step`.
  Eigen::VectorXd change(const Eigen::VectorXd& step) const;
  LinearMeasure damage(const CellState<dim>& before) const;
  double pressure(std::size_t node) const; ///< between the faces, Pa, >= 0

private:
  const InterfaceProblem<dim>& problem;
  const CellState<dim>& start;
  std::vector<double> augmentation; ///< Pa/m
  Eigen::VectorXd driving;
  std::vector<double> normal_traction; ///< augmented
};

} // namespace spall
