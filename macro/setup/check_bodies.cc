#include "macro/setup/check_bodies.h"

#include "macro/output/fragments.h"
#include "shared/error.h"

#include <cmath>
#include <cstdio>

namespace spall {
namespace {

/// Fraction of the points that may lack neighbours, because a sharp tip has one such point.
constexpr double most_without_gradient = 0.01;

/// Distance of the next layer and of the next ring, in support radii, at which the neighbours of every point
/// of a polar layout just hold a linear field; measured with normalized sizes of 1.9 to 2.5.
constexpr double layer_reach = 1 / 1.28, ring_reach = 1 / 1.40;

/// Largest height of a cell over its width, and largest width over its height, for a normalized support size
/// a: the support radius is a (width^2 height)^(1/3).
double largest_height(double a) { return std::pow(layer_reach * a, 1.5); }
double largest_width(double a) { return std::pow(ring_reach * a, 3); }

std::string advice(const SolidInputs& inputs) {
  const double size = inputs.approximation.support.normalized_size;
  char text[300];
  std::snprintf(
      text, sizeof text,
      "; change Rings, Layers or Spacing: it needs at least two layers of points, and with "
      "Approximation/Support size = %.3g its cells may be %.1f times as high as wide, or %.1f times as "
      "wide as high",
      size, largest_height(size), largest_width(size));
  return text;
}

} // namespace

void check_bodies(Simulation& run, const SolidInputs& inputs, const std::string& file) {
  for (const auto& solid : run.bodies.solids) {
    const auto refuse = [&](const std::string& what) {
      throw InputError(file + ": the body '" + solid->label + "' " + what + advice(inputs));
    };
    const RefreshReport report = solid->refresh();
    const std::size_t all =
        static_cast<std::size_t>(solid->ghosts.processes().sum(static_cast<double>(solid->points.owned)));
    // A quadratic basis falls back to a linear one at edges and corners, which is no fault.
    const std::size_t without_gradient =
        report.isolated + (inputs.approximation.order == 1 ? report.regularized : 0);
    const std::string few = "the neighbours of " + std::to_string(without_gradient) + " of its " +
                            std::to_string(all) + " points do not hold a linear field";
    if (static_cast<double>(without_gradient) > most_without_gradient * static_cast<double>(all))
      refuse("cannot be computed: " + few);
    if (without_gradient > 0) run.health.warnings.push_back("the body '" + solid->label + "': " + few);
    const std::size_t pieces = find_fragments(*solid, {}, 0, 0).list.size();
    if (pieces > 1) refuse("is not one piece, but " + std::to_string(pieces) + " pieces that do not touch");
  }
}

} // namespace spall
