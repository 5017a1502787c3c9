#include "micro/cohesive/node_response.h"

#include <algorithm>
#include <cmath>

namespace spall {
namespace {

/// Solves traction(d) + augmentation d = target for d in (0, w_f) by Newton's method; the left-hand side
/// increases with d. One iteration is exact for linear softening.
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

template<int dim>
NodeResponse<dim> node_response(const CohesiveLaw& law, const MixedMode& mode, double augmentation,
                                const NodeHistory<dim>& history, const Opening<dim>& augmented) {
  NodeResponse<dim> response;
  const double largest = history.largest, weight = mode.traction_weight();
  // Contact is a projection: with a compressive augmented traction only the tangential part of the law acts.
  const bool contact = augmented[0] <= 0, intact = largest <= 0;
  const double stored = intact ? 0 : secant_stiffness(law, largest);
  Opening<dim> driving = augmented;
  if (contact) driving[0] = 0;
  Slip<dim> shear = driving.template tail<dim - 1>();
  double turning = 0; // derivative of the friction direction with the shear traction, across the direction,
                      // times the friction
  if (contact && mode.friction > 0) {
    // Radial return: the traction in addition to the law that would prevent sliding, and the limit of
    // friction.
    const Slip<dim> needed = shear - weight * (augmentation + stored) * history.slip;
    const double limit = -mode.friction * augmented[0], size = needed.norm();
    // A node that has slid is on the Coulomb cone up to round-off and is taken as sliding, like a loading
    // one.
    if (size <= (intact ? limit + mode.strength_ratio * law.strength() : (1 - loading_tolerance) * limit)) {
      response.opening.template tail<dim - 1>() = history.slip;
      return response;
    }
    response.friction = mode.friction / size * needed;
    turning = limit / size;
    shear += augmented[0] * response.friction;
    driving.template tail<dim - 1>() = shear;
  }
  const double size =
      mode.strength_ratio == 1 ? driving.norm() : std::hypot(driving[0], shear.norm() / mode.strength_ratio);
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
  Opening<dim> direction = Opening<dim>::Zero(); // opening over effective opening
  if (size > 0) {
    direction = driving / size;
    direction.template tail<dim - 1>() /= weight;
  } else if (!contact) {
    direction[0] = 1;
  }
  response.opening = opening * direction;
  response.free.fill(true);
  const double g = mode.opening_weight();
  Opening<dim> weights = Opening<dim>::Constant(weight), squares = Opening<dim>::Constant(g * g);
  weights[0] = squares[0] = 1;
  response.tangent =
      secant * weights.asDiagonal().toDenseMatrix() +
      (slope - secant) * weights.cwiseProduct(direction) * squares.cwiseProduct(direction).transpose();
  if (contact) {
    response.free[0] = false;
    response.tangent.row(0).setZero();
    response.tangent.col(0).setZero();
    if constexpr (dim > 2)
      if (turning > 0) {
        // Friction turns with the slip direction: only (1 - turning) of a change of shear across it acts on
        // the law.
        using Block = Eigen::Matrix<double, dim - 1, dim - 1>;
        const Slip<dim> along = response.friction / mode.friction;
        const Block across = Block::Identity() - along * along.transpose();
        const double gain = turning / std::max(1 - turning, loading_tolerance);
        auto block = response.tangent.template bottomRightCorner<dim - 1, dim - 1>();
        block += (gain * across * (block + weight * augmentation * Block::Identity())).eval();
      }
  }
  return response;
}

template NodeResponse<2> node_response<2>(const CohesiveLaw&, const MixedMode&, double, const NodeHistory<2>&,
                                          const Opening<2>&);
template NodeResponse<3> node_response<3>(const CohesiveLaw&, const MixedMode&, double, const NodeHistory<3>&,
                                          const Opening<3>&);

} // namespace spall
