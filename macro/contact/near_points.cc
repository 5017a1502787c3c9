#include "macro/contact/near_points.h"

#include <algorithm>
#include <cmath>

namespace spall {

Bounds box_of(const Points& points, double margin) {
  Bounds box;
  for (int c = 0; c < 3; ++c) {
    for (const double x : points.position.component[c]) {
      box.low[c] = std::min(box.low[c], x);
      box.high[c] = std::max(box.high[c], x);
    }
    box.low[c] -= margin, box.high[c] += margin;
  }
  return box;
}

double largest_spacing(const Points& points) {
  return points.owned > 0 ? *std::max_element(points.spacing.begin(), points.spacing.end()) : 0;
}

void NearPoints::rebuild(const ContactBody& body, const Bounds& box) {
  const Points& points = *body.points;
  index.clear();
  edges.clear();
  spacings.clear();
  extent = 0;
  const std::size_t count = points.position.component[0].size();
  for (std::size_t i = 0; i < count; ++i)
    if (box.holds(points.position[i])) index.push_back(static_cast<std::uint32_t>(i));
  if (index.empty()) return;
  Points copy; // a copy of the positions only
  copy.position.resize(index.size());
  double spacing = 0, stretch = 0;
  for (std::size_t n = 0; n < index.size(); ++n) {
    copy.position.set(n, points.position[index[n]]);
    const std::uint32_t owner = body.ghosts->owner(points, index[n]);
    spacing = std::max(spacing, points.spacing[owner]);
    Mat3 f = points.deformation(owner);
    for (int c = 0; c < 3; ++c) {
      const Vec3 edge = body.ghosts->mirror(points, index[n], {f[c], f[3 + c], f[6 + c]});
      for (int r = 0; r < 3; ++r) f[3 * r + c] = points.spacing[owner] * edge[r];
    }
    // Both sides are mapped, so that f refers to the initial configuration of the image, not of its owner.
    for (int r = 0; r < 3; ++r) {
      const Vec3 row = body.ghosts->mirror(points, index[n], {f[3 * r], f[3 * r + 1], f[3 * r + 2]});
      for (int c = 0; c < 3; ++c) f[3 * r + c] = row[c];
    }
    const Sym3 squared = times_transpose(f);
    stretch = std::max(stretch, largest_eigenvalue(squared));
    edges.push_back(f);
    spacings.push_back(points.spacing[owner]);
  }
  limit = largest_cell_stretch * spacing;
  extent = std::min(limit, std::max(spacing, std::sqrt(stretch)));
  search.rebuild(copy, spacing);
}

} // namespace spall
