#include "macro/points/ghosts.h"

#include "shared/traffic.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace spall {
namespace {

double square(double x) { return x * x; }

} // namespace

int points_on_ring(double radius, double spacing) {
  return 4 * std::max(1, static_cast<int>(std::lround(0.5 * std::numbers::pi * std::abs(radius) / spacing)));
}

double gap_on_ring(double radius, double spacing) {
  return 2 * std::numbers::pi * std::abs(radius) / points_on_ring(radius, spacing);
}

void Ghosts::rebuild(Points& points, const Vec3& reach, bool keep, std::vector<Bounds> boxes) {
  if (!keep) images.clear(), present.clear();
  if (planes.axis) images.resize(keep ? halo.size() : 0);
  const auto make_room = [&] {
    for (VectorField* field : {&points.position, &points.velocity, &points.force})
      field->resize(points.owned + images.size());
  };
  if (halo.processes().several()) {
    add_remote(points, boxes, keep);
    make_room();
    halo.update({&points.position}); // images are chosen by positions
  }
  if (planes.axis)
    add_rotations(points, halo.processes().max(reach[1]), boxes);
  else
    add_reflections(points, reach);
  make_room();
  refresh(points);
}

void Ghosts::drop_images(Points& points) {
  images.resize(halo.size());
  present.clear();
  for (VectorField* field : {&points.position, &points.velocity, &points.force})
    field->resize(points.owned + images.size());
}

void Ghosts::add_remote(Points& points, std::vector<Bounds> boxes, bool keep) {
  // A point behind a symmetry plane is the image of one in front of it, and a point beside the half plane is
  // the image of one at the same radius in it. So the boxes are mapped to the region of the owners.
  for (Bounds& box : boxes) {
    for (int c = 0; c < 3; ++c)
      if (planes.normal[c]) box.high[c] = std::max(box.high[c], -box.low[c]);
    if (planes.axis) box.high[0] = std::hypot(std::max(box.high[0], -box.low[0]), box.high[1]);
  }
  const auto next = static_cast<std::uint32_t>(points.owned + images.size());
  const std::size_t added = halo.rebuild(points, boxes, next, keep);
  for (std::size_t k = 0; k < added; ++k) images.push_back({.owner = static_cast<std::uint32_t>(next + k)});
}

void Ghosts::add_reflections(const Points& points, const Vec3& reach) {
  const std::size_t count = points.owned + images.size();
  present.resize(count);
  for (int mask = 1; mask < 8; ++mask) {
    std::array<double, 3> sign = {1, 1, 1};
    bool used = true;
    for (int c = 0; c < 3; ++c)
      if (mask >> c & 1) sign[c] = -1, used = used && planes.normal[c];
    if (!used) continue;
    for (std::size_t i = 0; i < count; ++i) {
      if (i >= points.owned && !is_remote(points, i)) continue;
      bool near = true;
      for (int c = 0; c < 3; ++c) near = near && (sign[c] > 0 || points.position.component[c][i] < reach[c]);
      if (!near || present[i] >> mask & 1) continue;
      images.push_back({.owner = static_cast<std::uint32_t>(i), .xx = sign[0], .yy = sign[1], .z = sign[2]});
      present[i] |= static_cast<std::uint8_t>(1 << mask);
    }
  }
}

void Ghosts::add_rotations(const Points& points, double reach, const std::vector<Bounds>& boxes) {
  const auto meets = [](const Bounds& box, double r, double z) {
    return z >= box.low[2] && z <= box.high[2] && r >= box.low[0] &&
           r * r <= square(std::max(box.high[0], -box.low[0])) + square(std::max(box.high[1], -box.low[1]));
  };
  // The positions of remote points have been received already, their spacings have not.
  const std::size_t rings = points.owned + images.size();
  VectorField spacing;
  spacing.component[0] = points.spacing;
  spacing.resize(rings);
  halo.update({&spacing});
  for (std::size_t i = 0; i < rings; ++i) {
    const double r = points.position.component[0][i], z = points.position.component[2][i];
    const auto meets_ring = [&](const Bounds& box) { return meets(box, r, z); };
    if (!boxes.empty() && std::none_of(boxes.begin(), boxes.end(), meets_ring)) continue;
    const int n = points_on_ring(r, spacing.component[0][i]);
    // Far from the axis only the next few on both sides can be in reach.
    const int last =
        r < 2 * reach ? n / 2 : static_cast<int>(n * std::asin(reach / r) / (2 * std::numbers::pi)) + 1;
    const double gap = 2 * std::numbers::pi / n, of_gap_c = std::cos(gap), of_gap_s = std::sin(gap);
    for (double k = 1, c = of_gap_c, s = of_gap_s; k <= last; ++k) {
      // Images on the other side of the axis are left out unless they are in reach as well.
      if (r * std::abs(s) < reach && -r * c < reach) {
        const auto owner = static_cast<std::uint32_t>(i);
        images.push_back({.owner = owner, .xx = c, .xy = -s, .yx = s, .yy = c});
        if (2 * k != n) images.push_back({.owner = owner, .xx = c, .xy = s, .yx = -s, .yy = c});
      }
      const double before = c; // the next angle
      c = of_gap_c * c - of_gap_s * s, s = of_gap_s * before + of_gap_c * s;
    }
  }
}

void Ghosts::refresh(Points& points) const { refresh(points, {&points.position, &points.velocity}); }

void Ghosts::refresh(const Points& points, const std::vector<VectorField*>& fields) const {
  const TrafficOf use(MpiUse::velocities);
  halo.update(fields);
  for (VectorField* field : fields)
    for (std::size_t g = 0; g < images.size(); ++g)
      field->set(points.owned + g, images[g].at_image((*field)[images[g].owner]));
}

void Ghosts::add_back(Points& points) const {
  for (std::size_t g = 0; g < images.size(); ++g) {
    if (images[g].owner == points.owned + g) continue;
    points.force.add(images[g].owner, images[g].at_owner(points.force[points.owned + g]));
  }
  const TrafficOf use(MpiUse::forces);
  halo.add_back(points.force);
  if (planes.axis) std::fill_n(points.force.component[1].begin(), points.owned, 0.0);
}

} // namespace spall
