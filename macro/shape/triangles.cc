#include "macro/shape/triangles.h"

#include <cmath>
#include <numbers>

namespace spall {
namespace {

constexpr std::int64_t around = 48;

/// The points of the surface at one place of an outline: a ring, or one point of the axis.
struct Ring {
  std::int64_t first = 0;
  bool on_axis = false;

  std::int64_t point(std::int64_t k) const { return on_axis ? first : first + k % around; }
};

Ring add_ring(Triangles& surface, const ContourPoint& at) {
  const Ring ring{static_cast<std::int64_t>(surface.points.size()), !(at.r > 0)};
  for (std::int64_t k = 0; k < (ring.on_axis ? 1 : around); ++k) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(k) / around;
    surface.points.push_back({at.r * std::cos(angle), at.r * std::sin(angle), at.z});
  }
  return ring;
}

Triangles turned_triangles(const std::vector<ContourPoint>& outline) {
  Triangles surface;
  if (outline.empty()) return surface;
  std::vector<Ring> rings;
  for (const ContourPoint& at : outline) {
    const ContourPoint& first = outline.front();
    const bool closes = !rings.empty() && at.r > 0 && at.r == first.r && at.z == first.z;
    rings.push_back(closes ? rings.front() : add_ring(surface, at));
  }
  for (std::size_t i = 0; i + 1 < rings.size(); ++i)
    for (std::int64_t k = 0; k < around; ++k) {
      const Ring &a = rings[i], &b = rings[i + 1];
      if (!b.on_axis) surface.corners.push_back({a.point(k), b.point(k), b.point(k + 1)});
      if (!a.on_axis) surface.corners.push_back({a.point(k), b.point(k + 1), a.point(k + 1)});
    }
  return surface;
}

Triangles triangles_of(const Block& block) {
  Triangles surface;
  for (int i = 0; i < 8; ++i)
    surface.points.push_back(
        {((i & 1) - 0.5) * block.width, ((i >> 1 & 1) - 0.5) * block.depth, (i >> 2 & 1) * block.height});
  constexpr std::array<std::array<std::int64_t, 4>, 6> faces = {
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  for (const auto& [a, b, c, d] : faces) {
    surface.corners.push_back({a, b, c});
    surface.corners.push_back({a, c, d});
  }
  return surface;
}

} // namespace

Triangles triangles_of(const Shape& shape) {
  if (const Block* block = std::get_if<Block>(&shape)) return triangles_of(*block);
  if (const ClosedSurface* surface = std::get_if<ClosedSurface>(&shape)) return surface->triangles();
  return turned_triangles(outline(shape));
}

} // namespace spall
