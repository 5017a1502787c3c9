#include "macro/scene/fill.h"

#include "macro/points/order.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace spall {
namespace {

/// Positions and extents of n cells that share a length.
struct Division {
  std::vector<double> position, begin, end;
};

Division divide(double length, int n, Boundary low, Boundary high) {
  // Cells at a surface whose point lies on it are halves.
  const double cells = n - (low == Boundary::on_surface ? 0.5 : 0) - (high == Boundary::on_surface ? 0.5 : 0);
  const double h = length / cells;
  Division d;
  for (int i = 0; i < n; ++i) {
    const double x = h * (i + (low == Boundary::on_surface ? 0.0 : 0.5));
    d.position.push_back(x);
    d.begin.push_back(std::max(0.0, x - 0.5 * h));
    d.end.push_back(std::min(length, x + 0.5 * h));
  }
  return d;
}

} // namespace

Points fill_cylinder(const Cylinder& cylinder, int rings, int layers, Boundary boundary,
                     const SymmetryPlanes& planes, double density, const Jitter& jitter) {
  using std::numbers::pi;
  const Division radial = divide(cylinder.radius, rings, Boundary::centred, boundary);
  const Division axial = divide(cylinder.height, layers, boundary, boundary);
  // Outermost points on the surface stay there: no displacement across a cell that is cut off.
  const auto across = [&](const Division& d, int i) {
    const double cell = d.end[i] - d.begin[i],
                 to_wall = std::min(d.position[i] - d.begin[i], d.end[i] - d.position[i]);
    return to_wall > 1e-9 * cell ? 0.5 * jitter.amount * cell : 0.0;
  };
  std::mt19937_64 random(static_cast<std::uint64_t>(jitter.seed));
  // The same numbers with every standard library: 53 bits, from -1 to 1.
  const auto uniform = [&random] { return std::ldexp(static_cast<double>(random() >> 11), -52) - 1; };

  std::vector<Vec3> positions;
  std::vector<double> volumes;
  for (int i = 0; i < rings; ++i) {
    const double r = radial.position[i],
                 width = rings > 1 ? radial.position[1] - radial.position[0] : cylinder.radius;
    const int around = planes.axis ? 1 : points_on_ring(r, width);
    const double area = pi * (radial.end[i] * radial.end[i] - radial.begin[i] * radial.begin[i]) / around;
    for (int j = 0; j < around; ++j) {
      const double gap = planes.axis ? 0 : 2 * pi / around, angle = gap * (j + 0.5);
      if ((planes.normal[0] && std::cos(angle) < 0) || (planes.normal[1] && std::sin(angle) < 0)) continue;
      for (int k = 0; k < layers; ++k) {
        const double s = r + across(radial, i) * uniform(), t = angle + 0.5 * jitter.amount * gap * uniform();
        positions.push_back({s * std::cos(t), s * std::sin(t),
                             cylinder.bottom + axial.position[k] + across(axial, k) * uniform()});
        volumes.push_back(area * (axial.end[k] - axial.begin[k]));
      }
    }
  }
  // One spacing for the whole body: the edge of a whole cell.
  const double height = layers > 1 ? axial.position[1] - axial.position[0] : cylinder.height;
  const double width = rings > 1 ? radial.position[1] - radial.position[0] : cylinder.radius;
  const double spacing = std::cbrt(height * width * width);

  const auto order = hilbert_order(positions);
  Points points;
  points.resize(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    points.position.set(i, positions[order[i]]);
    points.volume[i] = volumes[order[i]];
    points.mass[i] = density * points.volume[i];
    points.spacing[i] = spacing;
  }
  points.initial_position = points.position;
  points.surface_offset = boundary == Boundary::on_surface ? 0 : 0.5;
  return points;
}

} // namespace spall
