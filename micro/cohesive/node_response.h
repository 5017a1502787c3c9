#pragma once

#include "micro/cohesive/cohesive_law.h"
#include "micro/cohesive/mixed_mode.h"

#include <Eigen/Core>

#include <array>

namespace spall {

/// The response of a pair of crack-face nodes to an augmented traction.
template<int dim> struct NodeResponse {
  Opening<dim> opening = Opening<dim>::Zero(); ///< m
  /// Tangent stiffness d traction / d opening on the free components, Pa/m.
  Eigen::Matrix<double, dim, dim> tangent = Eigen::Matrix<double, dim, dim>::Zero();
  /// Components that may change; the others are held at the values in `opening`.
  std::array<bool, dim> free{};
  bool loading = false; ///< whether damage grows
  /// Friction traction per unit of contact pressure while the faces slide: mu times the slip direction; else
  /// 0.
  Slip<dim> friction = Slip<dim>::Zero();
};

/// Relative tolerance of the loading condition: a damaged node unloads only if it is below the threshold by
/// more than this. After a converged step every damaged node is at its threshold up to round-off. Treating
/// those nodes as unloading doubles the iterations and can lead the next step to the wrong branch.
inline constexpr double loading_tolerance = 1e-9;

/// History variables of a node pair at the beginning of a step.
template<int dim> struct NodeHistory {
  /// Largest effective opening so far, m: 0 never opened, >= w_f broken or initially open.
  double largest = 0;
  /// Slip before the step, m, at which friction holds the node while it sticks.
  Slip<dim> slip = Slip<dim>::Zero();
};

/// Returns the opening w with traction(w) + A w = augmented: the exact law, without a penalty, for any
/// augmentation A above law.steepest_slope(). The augmented traction alone determines whether the node stays
/// closed (|traction| <= f_t, never opened), softens, unloads towards the origin, is broken, or is in contact
/// (normal opening zero, compressive reaction; sliding is resisted by Coulomb friction in addition to the
/// law). In the tangential direction A is multiplied by mode.traction_weight(), so that only a scalar
/// equation has to be solved. Friction uses a radial return, as in plasticity: the friction traction opposes
/// the trial slip, which follows from the secant stiffness at the beginning of the step. In 2D this is exact;
/// in 3D it is exact if damage does not grow or the direction of shear does not turn within the step.
/// @param augmented augmented traction, traction + A * opening, Pa
template<int dim>
NodeResponse<dim> node_response(const CohesiveLaw& law, const MixedMode& mode, double augmentation,
                                const NodeHistory<dim>& history, const Opening<dim>& augmented);

/// Secant stiffness of the unloading line, Pa/m: traction over effective opening at the largest opening so
/// far.
double secant_stiffness(const CohesiveLaw& law, double largest);

} // namespace spall
