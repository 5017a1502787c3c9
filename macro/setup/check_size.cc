#include "macro/setup/check_size.h"

#include "shared/input/quantity.h"
#include "shared/memory.h"

#include <cmath>

namespace spall {
namespace {

/// Memory of a point with its neighbours and gradients, bytes: measured, 1,915 for a million points of a
/// slab.
constexpr double bytes_per_point = 2000;

} // namespace

void check_size(const SceneInputs& scene, const Ranks& ranks, const std::string& file) {
  double points = 0;
  for (const BodyInputs& body : scene.bodies)
    if (body.is_deformable()) points += body.expected_points(scene.planes());
  require_memory(points * bytes_per_point / ranks.count(),
                 file + ": its " + format_quantity(std::round(points), Dimension::none) + " points");
}

} // namespace spall
