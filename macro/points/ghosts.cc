#include "macro/points/ghosts.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace spall {

int points_on_ring(double radius, double spacing) {
  return 4 * std::max(1, static_cast<int>(std::lround(0.5 * std::numbers::pi * std::abs(radius) / spacing)));
}

double gap_on_ring(double radius, double spacing) {
  return 2 * std::numbers::pi * std::abs(radius) / points_on_ring(radius, spacing);
}

void Ghosts::rebuild(Points& points, const Vec3& reach, bool keep) {
  if (!keep || planes.axis) images.clear(), present.clear();
  if (planes.axis)
    add_rotations(points, reach[1]);
  else
    add_reflections(points, reach);
  for (VectorField* field : {&points.position, &points.velocity, &points.force})
    field->resize(points.owned + images.size());
  refresh(points);
}

void Ghosts::add_reflections(const Points& points, const Vec3& reach) {
  present.resize(points.owned);
  for (int mask = 1; mask < 8; ++mask) {
    std::array<double, 3> sign = {1, 1, 1};
    bool used = true;
    for (int c = 0; c < 3; ++c)
      if (mask >> c & 1) sign[c] = -1, used = used && planes.normal[c];
    if (!used) continue;
    for (std::size_t i = 0; i < points.owned; ++i) {
      bool near = true;
      for (int c = 0; c < 3; ++c) near = near && (sign[c] > 0 || points.position.component[c][i] < reach[c]);
      if (!near || present[i] >> mask & 1) continue;
      images.push_back({.owner = static_cast<std::uint32_t>(i), .xx = sign[0], .yy = sign[1], .z = sign[2]});
      present[i] |= static_cast<std::uint8_t>(1 << mask);
    }
  }
}

void Ghosts::add_rotations(const Points& points, double reach) {
  for (std::size_t i = 0; i < points.owned; ++i) {
    const double r = points.position.component[0][i];
    const int n = points_on_ring(r, points.spacing[i]);
    for (int k = 1; k < n; ++k) {
      const double angle = 2 * std::numbers::pi * k / n, c = std::cos(angle), s = std::sin(angle);
      // Opposite ones only around the axis, where they are in reach as well.
      if (r * std::abs(s) >= reach || -r * c >= reach) continue;
      images.push_back({.owner = static_cast<std::uint32_t>(i), .xx = c, .xy = -s, .yx = s, .yy = c});
    }
  }
}

void Ghosts::refresh(Points& points) const {
  for (VectorField* field : {&points.position, &points.velocity})
    for (std::size_t g = 0; g < images.size(); ++g)
      field->set(points.owned + g, images[g].at_image((*field)[images[g].owner]));
}

void Ghosts::add_back(Points& points) const {
  for (std::size_t g = 0; g < images.size(); ++g) {
    const Vec3 f = images[g].at_owner(points.force[points.owned + g]);
    for (int c = 0; c < 3; ++c) points.force.component[c][images[g].owner] += f[c];
  }
  if (planes.axis) std::fill_n(points.force.component[1].begin(), points.owned, 0.0);
}

} // namespace spall
