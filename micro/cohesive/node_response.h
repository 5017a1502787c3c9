#pragma once

#include "micro/cohesive/cohesive_law.h"
#include "micro/cohesive/mixed_mode.h"

#include <Eigen/Core>

namespace spall {

/// What a pair of crack-face nodes does under an augmented traction. Component 0 is normal to the crack
/// (opening positive), component 1 tangential.
struct NodeResponse {
  Eigen::Vector2d opening = Eigen::Vector2d::Zero(); ///< m
  Eigen::Matrix2d tangent = Eigen::Matrix2d::Zero(); ///< d traction / d opening, Pa/m, on the free components
  bool free[2] = {false, false}; ///< components that may change; the others are held where `opening` says
  bool loading = false;          ///< damage grows
  double friction = 0;           ///< slides: +-mu, the share of the pressure that resists; else 0
};

/// Below this fraction of the threshold a damaged node unloads; above it counts as loading. After a converged
/// step every damaged node sits on the threshold to round-off, and taking those for unloading doubles the
/// iterations and can send the next step onto the wrong branch.
inline constexpr double loading_tolerance = 1e-9;

/// What a node brings to a step.
struct NodeHistory {
  double largest =
      0;           ///< largest effective opening so far, m: 0 never opened, >= w_f broken or initially open
  double slip = 0; ///< tangential opening before the step, where friction holds it, m
};

/// The opening w with traction(w) + A w = augmented: the exact law, without a penalty, for any augmentation A
/// above law.steepest_slope(). It says at once whether the node stays closed (|traction| <= f_t, never
/// opened), softens, unloads towards the origin, is broken, or is in contact (normal opening zero,
/// compressive reaction; sliding is resisted by Coulomb friction on top of the law). Tangentially A is
/// multiplied by mode.traction_weight(), which keeps the inversion scalar.
///
/// @param augmented traction + A * opening, Pa
NodeResponse node_response(const CohesiveLaw& law, const MixedMode& mode, double augmentation,
                           const NodeHistory& history, const Eigen::Vector2d& augmented);

/// Traction over effective opening, Pa/m: the secant of the unloading line from the largest opening.
double secant_stiffness(const CohesiveLaw& law, double largest);

} // namespace spall
