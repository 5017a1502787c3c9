#include "macro/contact/facing_patch.h"

#include "macro/contact/contact_normal.h"

#include <algorithm>
#include <cmath>

namespace spall {

double find_facing_patch(SurfacePatch& patch, const Points& secondary, const NearPoints& near_secondary,
                         std::uint32_t n, const Points& primary, const NearPoints& near_primary,
                         double watched) {
  const Vec3 x = secondary.position[near_secondary.indices()[n]];
  // A point is either above the cell of one of the other body's points or far from all of them.
  const double across = facing_radius * near_primary.largest_extent();
  const double largest = std::max(near_secondary.spacing(n), near_primary.largest_spacing());
  const double above = watched * largest + secondary.surface_offset * near_secondary.largest_extent() +
                       primary.surface_offset * near_primary.largest_extent();
  const double far = std::sqrt(across * across + above * above);
  double nearest = far * far, facing = 0; // spacing of the nearest point, as it may vary along the surface
  near_primary.for_each(x, far, [&](std::uint32_t k, double dx, double dy, double dz) {
    const double square = dx * dx + dy * dy + dz * dz;
    if (square < nearest) nearest = square, facing = near_primary.spacing(k);
  });
  if (!(facing > 0)) return 0;
  const double spacing = std::max(near_secondary.spacing(n), facing);
  const Vec3 start = separating_direction(x, near_secondary, near_primary, contact_support * spacing);
  if (start == Vec3{} || !find_patch(patch, x, near_primary, primary.surface_offset, start)) return 0;
  patch.gap -= secondary.surface_offset * near_secondary.extent_along(n, patch.normal);
  return is_hidden(near_secondary, n, x, patch.normal) ? 0 : spacing;
}

} // namespace spall
