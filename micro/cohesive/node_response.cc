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

NodeResponse node_response(const CohesiveLaw& law, double augmentation, double largest,
                           const Eigen::Vector2d& augmented) {
  NodeResponse response;
  // Contact is a projection: a compressive augmented traction leaves only the tangential law.
  const bool contact = augmented[0] <= 0;
  const Eigen::Vector2d driving(contact ? 0 : augmented[0], augmented[1]);
  const double size = driving.norm();
  const bool intact = largest <= 0;
  if (intact && size <= law.strength()) return response;

  double opening = 0, slope = 0, secant = 0;
  const double stored = intact ? 0 : secant_stiffness(law, largest);
  if (largest >= law.final_opening()) {
    opening = size / augmentation;
  } else if (!intact && size < (stored + augmentation) * largest * (1 - loading_tolerance)) {
    opening = size / (stored + augmentation);
    slope = secant = stored;
  } else if (size >= augmentation * law.final_opening()) {
    opening = size / augmentation;
  } else {
    opening = loading_opening(law, augmentation, size);
    slope = law.slope(opening);
    secant = law.traction(opening) / opening;
  }
  const Eigen::Vector2d direction = size > 0 ? Eigen::Vector2d(driving / size) : Eigen::Vector2d(1, 0);
  response.opening = opening * direction;
  response.free[0] = !contact;
  response.free[1] = true;
  if (contact)
    response.tangent(1, 1) = size > 0 ? slope : secant;
  else
    response.tangent =
        secant * Eigen::Matrix2d::Identity() + (slope - secant) * direction * direction.transpose();
  return response;
}

} // namespace spall
