#pragma once

#include "micro/cohesive/cohesive_law.h"

#include <Eigen/Core>

namespace spall {

/// What a pair of crack-face nodes does under an augmented traction. Component 0 is normal to the crack
/// (opening positive), component 1 tangential.
struct NodeResponse {
  Eigen::Vector2d opening = Eigen::Vector2d::Zero(); ///< m
  Eigen::Matrix2d tangent = Eigen::Matrix2d::Zero(); ///< d traction / d opening, Pa/m, on the free components
  bool free[2] = {false, false}; ///< components that may change; the others are held at zero opening
};

/// Below this fraction of the threshold a damaged node unloads; above it counts as loading. After a converged
/// step every damaged node sits on the threshold to round-off, and taking those for unloading doubles the
/// iterations and can send the next step onto the wrong branch.
inline constexpr double loading_tolerance = 1e-9;

/// The opening w with traction(w) + augmentation * w = augmented: the exact law, without a penalty, for any
/// augmentation above law.steepest_slope(). It says at once whether the node stays closed (|traction| <= f_t,
/// never opened), softens, unloads towards the origin, is broken, or is in contact (normal opening zero,
/// compressive reaction, frictionless). All modes count alike: the law acts along the opening vector.
///
/// @param largest largest effective opening so far, m: 0 never opened, >= w_f broken or initially open
/// @param augmented traction + augmentation * opening, Pa
NodeResponse node_response(const CohesiveLaw& law, double augmentation, double largest,
                           const Eigen::Vector2d& augmented);

/// Traction over effective opening, Pa/m: the secant of the unloading line from the largest opening.
double secant_stiffness(const CohesiveLaw& law, double largest);

} // namespace spall
