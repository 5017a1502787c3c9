#include "macro/integration/conforming_cells.h"

#include "macro/points/neighbor_search.h"
#include "macro/points/parallel.h"
#include "shared/error.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace spall {
namespace {

/// A convex polyhedron, stored as faces whose corners are counter-clockwise seen from outside.
class Polyhedron {
public:
  using Polygon = std::vector<Vec3>;

  /// Makes the cube [-half, half]^3.
  explicit Polyhedron(double half) {
    for (int axis = 0; axis < 3; ++axis)
      for (const double side : {half, -half}) {
        Polygon face;
        for (const auto& [u, v] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
          Vec3 corner;
          corner[axis] = side;
          corner[(axis + 1) % 3] = half * u;
          corner[(axis + 2) % 3] = half * v;
          face.push_back(corner);
        }
        if (side < 0) std::reverse(face.begin(), face.end());
        faces.push_back(face);
      }
  }

  /// Clips to a half-space (Sutherland and Hodgman's algorithm on every face, then the new face).
  void cut(const HalfSpace& plane) {
    const auto outside = [&](const Vec3& x) { return dot(plane.normal, x) - plane.offset; };
    bool any = false;
    for (const Polygon& face : faces)
      for (const Vec3& x : face) any = any || outside(x) > 0;
    if (!any) return;
    Polygon cap;
    for (Polygon& face : faces) {
      Polygon inside;
      for (std::size_t k = 0; k < face.size(); ++k) {
        const Vec3 &a = face[k], &b = face[(k + 1) % face.size()];
        const double da = outside(a), db = outside(b);
        if (da <= 0) inside.push_back(a);
        if ((da <= 0) != (db <= 0)) {
          inside.push_back(a + da / (da - db) * (b - a));
          cap.push_back(inside.back());
        }
      }
      face = std::move(inside);
    }
    std::erase_if(faces, [](const Polygon& face) { return face.size() < 3; });
    if (cap.size() >= 3) faces.push_back(ordered(std::move(cap), plane.normal));
  }

  double largest_distance() const {
    double square = 0;
    for (const Polygon& face : faces)
      for (const Vec3& x : face) square = std::max(square, dot(x, x));
    return std::sqrt(square);
  }

  std::vector<Polygon> faces;

private:
  /// Returns the corners of a convex polygon (given in any order, perhaps repeatedly) counter-clockwise about
  /// the normal.
  static Polygon ordered(Polygon corners, const Vec3& normal) {
    Vec3 centre{};
    for (const Vec3& x : corners) centre += x / static_cast<double>(corners.size());
    const Vec3 u = cross(normal, std::abs(normal[0]) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}),
               v = cross(normal, u);
    std::vector<std::pair<double, Vec3>> by_angle;
    for (const Vec3& x : corners) {
      const Vec3 d = x - centre;
      by_angle.emplace_back(std::atan2(dot(d, v), dot(d, u)), x);
    }
    std::sort(by_angle.begin(), by_angle.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    for (std::size_t k = 0; k < corners.size(); ++k) corners[k] = by_angle[k].second;
    return corners;
  }
};

/// Returns area vector and centroid of a face, from triangles about its first corner.
ConformingCells::Face measure(const Polyhedron::Polygon& polygon) {
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

/// Returns the Voronoi cell of one point, in coordinates relative to the point.
Polyhedron cell_of(std::size_t i, const Points& points, const NeighborSearch& search,
                   const std::vector<HalfSpace>& outline) {
  const double h = points.spacing[i];
  const Vec3 x = points.position[i];
  Polyhedron cell(2 * h);
  for (const HalfSpace& plane : outline) cell.cut({plane.normal, plane.offset - dot(plane.normal, x)});
  // A point farther away than twice the farthest corner cannot cut the cell.
  const double reach = 4 * h;
  std::vector<std::pair<double, Vec3>> others;
  search.for_each_in_box(x, {reach, reach, reach}, [&](std::uint32_t j, double dx, double dy, double dz) {
    if (const Vec3 d = {dx, dy, dz}; j != i) others.emplace_back(norm(d), d);
  });
  std::sort(others.begin(), others.end());
  for (const auto& [distance, d] : others) {
    if (distance > 2 * cell.largest_distance()) break;
    cell.cut({d / distance, 0.5 * distance});
  }
  return cell;
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
    for (const auto& polygon : cell_of(i, all, search, outline).faces) {
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
