#include "micro/cell/penny.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace spall {
namespace {

using Place = std::array<double, 2>;

Place blend(const Place& a, const Place& b, double share) {
  return {a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])};
}

/// Size of the square in the middle: half its edge over the radius. Values from 0.3 to 0.55 work; this one
/// makes the elements at its corners and sides similar.
constexpr double square_in_circle = 0.42;

/// Returns the number of rings from the crack front over a length, which is the number of elements that a
/// plane cell has there.
int rings(double length, const MeshDensity& density, int least) {
  return std::max(
      least, static_cast<int>(std::lround(density.elements * std::pow(2 * length, 1 / density.grading))));
}

/// Returns the k-th of 4 m places around a square of half edge `half`, counter-clockwise from its lower left
/// corner.
Place on_square(double half, int m, int k) {
  const double along = half * (2.0 * (k % m) / m - 1);
  switch (k / m) {
  case 0:
    return {along, -half};
  case 1:
    return {half, along};
  case 2:
    return {-along, half};
  default:
    return {-half, -along};
  }
}

/// Adds a square of m x m open quads, row by row. @return its 4 m vertices on the edge, in the order of
/// on_square
std::vector<unsigned int> add_square(PennyGrid& grid, double half, int m) {
  for (int j = 0; j <= m; ++j)
    for (int i = 0; i <= m; ++i)
      grid.vertices.push_back({half * (2.0 * i / m - 1), half * (2.0 * j / m - 1)});
  const auto vertex = [m](int i, int j) { return static_cast<unsigned int>(j * (m + 1) + i); };
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < m; ++i) {
      grid.quads.push_back({vertex(i, j), vertex(i + 1, j), vertex(i, j + 1), vertex(i + 1, j + 1)});
      grid.open.push_back(true);
    }
  std::vector<unsigned int> edge;
  for (int k = 0; k < 4 * m; ++k) {
    const int along = k % m;
    const std::array<unsigned int, 4> sides = {vertex(along, 0), vertex(m, along), vertex(m - along, m),
                                               vertex(0, m - along)};
    edge.push_back(sides[k / m]);
  }
  return edge;
}

} // namespace

PennyGrid penny_grid(const CellGeometry& geometry, const MeshDensity& density) {
  const int m = density.elements, around = 4 * m;
  const double circle = 0.5 * geometry.crack_ratio, segment = 0.5 * std::numbers::pi / m;
  const double radius = circle * std::sqrt(segment / std::sin(segment));
  PennyGrid grid;
  grid.heights = grid_lines(geometry, density).y;

  const auto on_circle = [&](int k) -> Place {
    const double angle = -0.75 * std::numbers::pi + k * segment;
    return {radius * std::cos(angle), radius * std::sin(angle)};
  };

  const double half = square_in_circle * radius;
  std::vector<unsigned int> inner = add_square(grid, half, m);

  const auto add_ring = [&](const auto& place, bool open) {
    std::vector<unsigned int> outer;
    for (int k = 0; k < around; ++k) {
      outer.push_back(static_cast<unsigned int>(grid.vertices.size()));
      grid.vertices.push_back(place(k));
    }
    for (int k = 0; k < around;
         ++k) { // the outward direction comes first, so that the element is right-handed
      const int next = (k + 1) % around;
      grid.quads.push_back({inner[k], outer[k], inner[next], outer[next]});
      grid.open.push_back(open);
    }
    inner = std::move(outer);
  };
  const int within = rings(radius - half, density, 2), beyond = rings(0.5 - radius, density, 2);
  for (int i = within - 1; i >= 0; --i) {
    const double inwards = std::pow(static_cast<double>(i) / within, density.grading);
    add_ring([&](int k) { return blend(on_circle(k), on_square(half, m, k), inwards); }, true);
  }
  for (int i = 1; i <= beyond; ++i) {
    const double outwards = std::pow(static_cast<double>(i) / beyond, density.grading);
    add_ring([&](int k) { return blend(on_circle(k), on_square(0.5, m, k), outwards); }, false);
  }
  for (Place& place : grid.vertices) place = {place[0] + 0.5, place[1] + 0.5};
  return grid;
}

double coarsest_ligament_element(const PennyGrid& grid) {
  double longest = 0;
  for (std::size_t i = 0; i < grid.quads.size(); ++i) {
    if (grid.open[i]) continue;
    const auto& q = grid.quads[i];
    for (const auto& [a, b] : {std::pair(q[0], q[1]), {q[1], q[3]}, {q[3], q[2]}, {q[2], q[0]}})
      longest = std::max(longest, std::hypot(grid.vertices[a][0] - grid.vertices[b][0],
                                             grid.vertices[a][1] - grid.vertices[b][1]));
  }
  return longest;
}

} // namespace spall
