#include "macro/shape/closed_surface.h"

#include "macro/points/parallel.h"
#include "macro/shape/stl_file.h"
#include "macro/shape/tetrahedra.h"

#include <map>
#include <mutex>
#include <tuple>

namespace spall {
namespace {

/// Cells of the grid of distances along the longest side of the box: bounds are then mostly within a few
/// percent of the body's length, and the grid is made in a fraction of a second.
constexpr double grid_cells = 32;

/// Sections of an outline, for pictures.
constexpr int sections = 64;

/// Nearer than this part of the size the direction from the foot is round-off, and the triangle's is taken.
constexpr double on_surface = 1e-9;

Vec3 normal_of(const std::array<Vec3, 3>& corners) {
  return unit(cross(corners[1] - corners[0], corners[2] - corners[0]));
}

} // namespace

ClosedSurface::Body::Body(Triangles triangles_, bool turned_)
    : triangles(std::move(triangles_)), turned(turned_), tree(triangles), low(triangles.points.front()),
      high(low) {
  for (const Vec3& x : triangles.points)
    for (int c = 0; c < 3; ++c) low[c] = std::min(low[c], x[c]), high[c] = std::max(high[c], x[c]);
  mass = solid_inside(triangles, 0.5 * (low + high));
  fill_grid();
}

void ClosedSurface::Body::fill_grid() {
  const Vec3 size = high - low;
  step = std::max({size[0], size[1], size[2]}) / grid_cells;
  for (int c = 0; c < 3; ++c) nodes[c] = 1 + static_cast<std::size_t>(std::ceil(size[c] / step));
  distance.resize(nodes[0] * nodes[1] * nodes[2]);
  for_each_index(nodes[1] * nodes[2], [&](std::size_t row) {
    for (std::size_t i = 0; i < nodes[0]; ++i) {
      const std::array<std::size_t, 3> n = {i, row % nodes[1], row / nodes[1]};
      Vec3 x = low;
      for (int c = 0; c < 3; ++c) x[c] += step * static_cast<double>(n[c]);
      distance[row * nodes[0] + i] = surface(x).distance;
    }
  });
}

SurfacePoint ClosedSurface::Body::surface(const Vec3& x) const {
  const auto [foot, triangle] = tree.nearest(x);
  const Vec3 away = x - foot;
  const double d = norm(away), sign = tree.inside(x) ? -1 : 1;
  if (d <= on_surface * (norm(low) + norm(high))) return {sign * d, normal_of(triangles.triangle(triangle))};
  return {sign * d, sign / d * away};
}

ClosedSurface::ClosedSurface(Triangles surface, bool turned)
    : body(std::make_shared<const Body>(std::move(surface), turned)) {}

ClosedSurface ClosedSurface::read(const std::filesystem::path& file, double unit) {
  // A body of a scene is asked for its shape many times.
  static std::mutex one_at_a_time;
  static std::map<std::tuple<std::string, double, std::filesystem::file_time_type>, ClosedSurface> known;
  const std::lock_guard lock(one_at_a_time);
  std::error_code missing; // then reading says so
  const auto key = std::tuple(file.string(), unit, std::filesystem::last_write_time(file, missing));
  if (const auto found = known.find(key); found != known.end()) return found->second;
  StlSurface read = read_stl(file, unit);
  return known.emplace(key, ClosedSurface(std::move(read.triangles), read.turned)).first->second;
}

SurfacePoint ClosedSurface::surface(const Vec3& x) const { return body->surface(x); }

double ClosedSurface::lower_bound(const Vec3& x) const {
  const Body& b = *body;
  if (!std::isfinite(x[0] + x[1] + x[2])) return std::numeric_limits<double>::infinity();
  double square = 0, way = 0; // of the box, of the nearest node
  std::size_t node = 0;
  for (int c = 2; c >= 0; --c) {
    const double beyond = std::max({0.0, b.low[c] - x[c], x[c] - b.high[c]});
    square += beyond * beyond;
    const double last = static_cast<double>(b.nodes[c] - 1),
                 n = std::clamp(std::round((x[c] - b.low[c]) / b.step), 0.0, last);
    const double off = x[c] - b.low[c] - b.step * n;
    way += off * off;
    node = node * b.nodes[c] + static_cast<std::size_t>(n);
  }
  const double nearby = b.distance[node] - std::sqrt(way);
  return square > 0 ? std::max(std::sqrt(square), nearby) : nearby;
}

double ClosedSurface::extent(const Vec3& direction) const {
  double most = -std::numeric_limits<double>::infinity();
  for (const Vec3& x : body->triangles.points) most = std::max(most, dot(x, direction));
  return most;
}

std::vector<Vec3> ClosedSurface::surface_samples(double spacing) const {
  std::vector<Vec3> samples = body->triangles.points;
  for (std::size_t f = 0; f < body->triangles.corners.size(); ++f) {
    const auto [a, b, c] = body->triangles.triangle(f);
    const int n = segments(std::max({norm(b - a), norm(c - b), norm(a - c)}), spacing);
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n - i; ++j)
        if (i < n && j < n && i + j > 0) // not a corner
          samples.push_back(a + 1.0 * i / n * (b - a) + 1.0 * j / n * (c - a));
  }
  return samples;
}

std::vector<ContourPoint> ClosedSurface::outline() const {
  const double bottom = body->low[2], height = body->high[2] - bottom;
  std::vector<double> radius(sections + 1);
  for (std::size_t f = 0; f < body->triangles.corners.size(); ++f) {
    const std::array<Vec3, 3> corners = body->triangles.triangle(f);
    for (int k = 0; k < 3; ++k) {
      Vec3 lower = corners[k], upper = corners[(k + 1) % 3];
      if (lower[2] > upper[2]) std::swap(lower, upper);
      const auto section = [&](double z) { return (z - bottom) / height * sections; };
      const double first = std::ceil(section(lower[2]) - 1e-9), last = section(upper[2]) + 1e-9;
      for (int s = std::max(0, static_cast<int>(first)); s <= std::min<double>(sections, last); ++s) {
        const double rise = upper[2] - lower[2], z = bottom + height * s / sections,
                     part = rise > 0 ? std::clamp((z - lower[2]) / rise, 0.0, 1.0) : 0;
        const Vec3 x = lower + part * (upper - lower);
        radius[s] =
            std::max({radius[s], std::hypot(x[0], x[1]), rise > 0 ? 0 : std::hypot(upper[0], upper[1])});
      }
    }
  }
  std::vector<ContourPoint> points = {{bottom + height, 0}};
  for (int s = sections; s >= 0; --s) points.push_back({bottom + height * s / sections, radius[s]});
  points.push_back({bottom, 0});
  return points;
}

double ClosedSurface::asymmetry(int axis) const {
  double most = 0;
  for (Vec3 x : body->triangles.points) {
    x[axis] = -x[axis];
    most = std::max(most, std::abs(surface(x).distance));
  }
  return most;
}

} // namespace spall
