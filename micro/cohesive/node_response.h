#pragma once

#include "micro/cohesive/cohesive_law.h"
#include "micro/cohesive/mixed_mode.h"

#include <Eigen/Core>

#include <array>

namespace spall {

/// What a pair of crack-face nodes does under an augmented traction.
template<int dim> struct NodeResponse {
  Opening<dim> opening = Opening<dim>::Zero(); ///< m
  /// d traction / d opening, Pa/m, on the free components.
  Eigen::Matrix<double, dim, dim> tangent = Eigen::Matrix<double, dim, dim>::Zero();
  std::array<bool, dim> free{}; ///< components that may change; the others are held where `opening` says
  bool loading = false;         ///< damage grows
  /// Where the faces slide under pressure: mu times the direction, the share of the pressure that resists;
  /// else 0.
  Slip<dim> friction = Slip<dim>::Zero();
};

/// Below this fraction of the threshold a damaged node unloads; above it counts as loading. After a converged
/// step every damaged node sits on the threshold to round-off, and taking those for unloading doubles the
/// iterations and can send the next step onto the wrong branch.
inline constexpr double loading_tolerance = 1e-9;

/// What a node brings to a step.
template<int dim> struct NodeHistory {
  /// Largest effective opening so far, m: 0 never opened, >= w_f broken or initially open.
  double largest = 0;
  Slip<dim> slip = Slip<dim>::Zero(); ///< before the step, where friction holds it, m
};

/// The opening w with traction(w) + A w = augmented: the exact law, without a penalty, for any augmentation A
/// above law.steepest_slope(). It says at once whether the node stays closed (|traction| <= f_t, never
/// opened), softens, unloads towards the origin, is broken, or is in contact (normal opening zero,
/// compressive reaction; sliding is resisted by Coulomb friction on top of the law). Tangentially A is
/// multiplied by mode.traction_weight(), which keeps the inversion scalar.
///
/// Friction returns radially, as plasticity does: it points against the slip that the secant stiffness of
/// before the step would let through. In 2D that is exact; in 3D it is where damage does not grow or the
/// direction of shear does not turn within the step.
///
/// @param augmented traction + A * opening, Pa
template<int dim>
NodeResponse<dim> node_response(const CohesiveLaw& law, const MixedMode& mode, double augmentation,
                                const NodeHistory<dim>& history, const Opening<dim>& augmented);

/// Traction over effective opening, Pa/m: the secant of the unloading line from the largest opening.
double secant_stiffness(const CohesiveLaw& law, double largest);

} // namespace spall
