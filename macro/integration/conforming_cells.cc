#include "macro/integration/conforming_cells.h"

#include "macro/points/neighbor_search.h"
#include "macro/points/parallel.h"
#include "shared/error.h"

#include <voro++/voro++.hh>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace spall {
namespace {

using Polygon = std::vector<Vec3>;

/// Returns area vector and centroid of a face, from triangles about its first corner.
ConformingCells::Face measure(const Polygon& polygon) {
  ConformingCells::Face face{};
  Vec3 moment{};
  double total = 0;
  for (std::size_t k = 2; k < polygon.size(); ++k) {
    const Vec3 twice = cross(polygon[k - 1] - polygon[0], polygon[k] - polygon[0]);
    const double area = 0.5 * norm(twice);
    total += area;
    face.area += 0.5 * twice;
    moment += area / 3 * (polygon[0] + polygon[k - 1] + polygon[k]);
  }
  face.centre = total > 0 ? moment / total : polygon[0];
  return face;
}

/// Returns the faces of a cell, corners counter-clockwise seen from outside, in units of `h`.
std::vector<Polygon> faces_of(voro::voronoicell& cell, double h) {
  std::vector<double> corner; // x, y, z of each
  std::vector<int> list;      // of each face: number of corners, and the corners
  cell.vertices(corner);
  cell.face_vertices(list);
  Vec3 inside{};
  cell.centroid(inside[0], inside[1], inside[2]);
  std::vector<Polygon> faces;
  for (std::size_t at = 0; at < list.size(); at += 1 + static_cast<std::size_t>(list[at])) {
    Polygon face;
    for (int k = 1; k <= list[at]; ++k) {
      const double* x = &corner[3 * static_cast<std::size_t>(list[at + static_cast<std::size_t>(k)])];
      face.push_back(h * Vec3{x[0], x[1], x[2]});
    }
    const ConformingCells::Face measured = measure(face);
    if (dot(measured.area, measured.centre - h * inside) < 0) std::reverse(face.begin(), face.end());
    faces.push_back(std::move(face));
  }
  return faces;
}

/// Returns the faces of the Voronoi cell of one point, in coordinates relative to the point, m. The cell is
/// cut with lengths in units of the spacing, because Voro++ compares with absolute tolerances.
std::vector<Polygon> cell_of(std::size_t i, const Points& points, const NeighborSearch& search,
                             const std::vector<HalfSpace>& outline) {
  const double h = points.spacing[i];
  const Vec3 x = points.position[i];
  voro::voronoicell cell;
  cell.init(-2, 2, -2, 2, -2, 2);
  for (const auto& [normal, offset] : outline)
    cell.plane(normal[0], normal[1], normal[2], 2 * (offset - dot(normal, x)) / h);
  const double reach = 4 * h;
  std::vector<std::pair<double, Vec3>> others; // in units of h
  search.for_each_in_box(x, {reach, reach, reach}, [&](std::uint32_t j, double dx, double dy, double dz) {
    if (const Vec3 d = Vec3{dx, dy, dz} / h; j != i) others.emplace_back(norm(d), d);
  });
  std::sort(others.begin(), others.end());
  for (const auto& [distance, d] : others) {
    // A point farther away than twice the farthest corner cannot cut the cell.
    if (distance * distance > 4 * cell.max_radius_squared()) break;
    cell.plane(d[0], d[1], d[2]);
  }
  return faces_of(cell, h);
}

} // namespace

std::vector<HalfSpace> cylinder_outline(double radius, double bottom, double height) {
  constexpr int sides = 128;
  const double half_angle = std::numbers::pi / sides;
  const double apothem =
      radius * std::sqrt(half_angle / std::tan(half_angle)); // the polygon has the area of the circle
  std::vector<HalfSpace> outline = {{{0, 0, 1}, bottom + height}, {{0, 0, -1}, -bottom}};
  for (int k = 0; k < sides; ++k) {
    const double angle = (2 * k + 1) * half_angle;
    outline.push_back({{std::cos(angle), std::sin(angle), 0}, apothem});
  }
  return outline;
}

ConformingCells voronoi_cells(const Points& points, const SymmetryPlanes& planes,
                              const std::vector<HalfSpace>& outline) {
  Points all = points;
  const double largest = *std::max_element(points.spacing.begin(), points.spacing.end());
  Ghosts ghosts(planes);
  ghosts.rebuild(all, {4 * largest, 4 * largest, 4 * largest});
  NeighborSearch search;
  search.rebuild(all, largest);

  std::vector<std::vector<ConformingCells::Face>> faces(points.owned);
  ConformingCells cells;
  cells.volume.resize(points.owned);
  for_each_index(points.owned, [&](std::size_t i) {
    const double negligible = 1e-12 * points.spacing[i] * points.spacing[i];
    for (const Polygon& polygon : cell_of(i, all, search, outline)) {
      const ConformingCells::Face face = measure(polygon);
      if (dot(face.area, face.area) < negligible * negligible) continue;
      cells.volume[i] += dot(face.area, face.centre) / 3;
      faces[i].push_back(face);
    }
  });
  cells.start.push_back(0);
  for (std::size_t i = 0; i < points.owned; ++i) {
    for (const ConformingCells::Face& face : faces[i]) {
      if (dot(face.centre, face.centre) > points.spacing[i] * points.spacing[i])
        throw ComputationError("point " + std::to_string(i) +
                               " is too far from its neighbours or the surface for a conforming cell: a face "
                               "lies more than one spacing away");
      cells.face.push_back(face);
    }
    cells.start.push_back(static_cast<std::uint32_t>(cells.face.size()));
  }
  return cells;
}

ConformingCells part_of(const ConformingCells& cells, const Share& share) {
  const auto first = static_cast<std::ptrdiff_t>(share.first),
             last = first + static_cast<std::ptrdiff_t>(share.count);
  ConformingCells part;
  part.start.assign(cells.start.begin() + first, cells.start.begin() + last + 1);
  part.face.assign(cells.face.begin() + part.start.front(), cells.face.begin() + part.start.back());
  part.volume.assign(cells.volume.begin() + first, cells.volume.begin() + last);
  for (std::uint32_t& start : part.start) start -= cells.start[share.first];
  return part;
}

void adopt_volumes(Points& points, const ConformingCells& cells) {
  for (std::size_t i = 0; i < points.owned; ++i) {
    points.mass[i] *= cells.volume[i] / points.volume[i];
    points.volume[i] = cells.volume[i];
  }
}

} // namespace spall
