#include "micro/cohesive/node_response.h"

#include <algorithm>
#include <cmath>

namespace spall {
namespace {

/// Solves traction(d) + augmentation d = target for d in (0, w_f) by Newton; the left side increases. Exact
/// after one iteration for linear softening.
double loading_opening(const CohesiveLaw& law, double augmentation, double target) {
  double d = (target - law.strength()) / (augmentation - law.steepest_slope());
  for (int i = 0; i < 50; ++i) {
    d = std::clamp(d, 0.0, law.final_opening());
    const double step = (target - law.traction(d) - augmentation * d) / (augmentation + law.slope(d));
    d += step;
    if (std::abs(step) <= 1e-15 * law.final_opening()) break;
  }
  return d;
}

} // namespace

double secant_stiffness(const CohesiveLaw& law, double largest) {
  return largest >= law.final_opening() ? 0 : law.traction(largest) / largest;
}

NodeResponse node_response(const CohesiveLaw& law, const MixedMode& mode, double augmentation,
                           const NodeHistory& history, const Eigen::Vector2d& augmented) {
  NodeResponse response;
  const double largest = history.largest, weight = mode.traction_weight();
  // Contact is a projection: a compressive augmented traction leaves only the tangential law.
  const bool contact = augmented[0] <= 0, intact = largest <= 0;
  const double stored = intact ? 0 : secant_stiffness(law, largest);
  Eigen::Vector2d driving(contact ? 0 : augmented[0], augmented[1]);
  if (contact && mode.friction > 0) {
    // What has to be held beyond the law to keep the faces from sliding, and what friction can hold.
    const double needed = augmented[1] - weight * (augmentation + stored) * history.slip;
    const double limit = -mode.friction * augmented[0];
    if (std::abs(needed) <= limit + (intact ? mode.strength_ratio * law.strength() : 0)) {
      response.opening[1] = history.slip;
      return response;
    }
    response.friction = std::copysign(mode.friction, needed);
    driving[1] += response.friction * augmented[0];
  }
  const double size =
      mode.strength_ratio == 1 ? driving.norm() : std::hypot(driving[0], driving[1] / mode.strength_ratio);
  if (intact && size <= law.strength()) return response;

  double opening = 0, slope = 0, secant = 0;
  if (largest >= law.final_opening()) {
    opening = size / augmentation;
  } else if (!intact && size < (stored + augmentation) * largest * (1 - loading_tolerance)) {
    opening = size / (stored + augmentation);
    slope = secant = stored;
  } else if (size >= augmentation * law.final_opening()) {
    opening = size / augmentation;
    response.loading = true;
  } else {
    opening = loading_opening(law, augmentation, size);
    slope = law.slope(opening);
    secant = law.traction(opening) / opening;
    response.loading = true;
  }
  // Opening over effective opening.
  const Eigen::Vector2d direction =
      size > 0 ? Eigen::Vector2d(driving[0] / size, driving[1] / size / weight) : Eigen::Vector2d(1, 0);
  response.opening = opening * direction;
  response.free[0] = !contact;
  response.free[1] = true;
  if (contact) {
    response.tangent(1, 1) = weight * (size > 0 ? slope : secant);
  } else {
    const double g = mode.opening_weight();
    response.tangent = secant * Eigen::Vector2d(1, weight).asDiagonal().toDenseMatrix() +
                       (slope - secant) * Eigen::Vector2d(direction[0], weight * direction[1]) *
                           Eigen::RowVector2d(direction[0], g * g * direction[1]);
  }
  return response;
}

} // namespace spall
