#include "macro/shape/fill.h"

#include "macro/points/order.h"

#include <algorithm>
#include <numbers>
#include <random>

namespace spall {
namespace {

using std::numbers::pi;

/// Cells side by side over a length: points, extents and widths of the whole cells, m.
struct Division {
  std::vector<double> position, begin, end, width;

  std::size_t size() const { return position.size(); }
};

/// Cells of these widths, all scaled by one factor to fill the length. Those at a surface whose point lies on
/// it are halves.
Division divide(double length, const std::vector<double>& widths, Boundary low, Boundary high) {
  double sum = 0;
  for (const double w : widths) sum += w;
  if (low == Boundary::on_surface) sum -= 0.5 * widths.front();
  if (high == Boundary::on_surface) sum -= 0.5 * widths.back();
  const double scale = length / sum;
  Division d;
  double begin = low == Boundary::on_surface ? -0.5 * widths.front() : 0;
  for (const double w : widths) {
    const double x = scale * (begin + 0.5 * w), half = 0.5 * scale * w;
    d.position.push_back(x);
    d.begin.push_back(std::max(0.0, x - half));
    d.end.push_back(std::min(length, x + half));
    d.width.push_back(scale * w);
    begin += w;
  }
  return d;
}

/// Layers over a height.
Division stack(double height, int layers, Boundary boundary) {
  return divide(height, std::vector<double>(static_cast<std::size_t>(layers), 1.0), boundary, boundary);
}

/// Widths of graded rings from the axis outwards, before they are made to fit: the last one is that of which
/// more than half fits.
std::vector<double> ring_widths(double radius, const Grading& grading) {
  std::vector<double> widths;
  double width = grading.fine_spacing, r = 0;
  do {
    widths.push_back(width);
    r += width;
    if (r > (1 - 1e-9) * grading.fine_radius)
      width = std::min(width * grading.growth, grading.coarse_spacing);
  } while (r + 0.5 * width < radius);
  return widths;
}

bool modelled(const SymmetryPlanes& planes, double x, double y) {
  return !(planes.normal[0] && x < 0) && !(planes.normal[1] && y < 0);
}

/// Collects the cells of a body, column by column over the height.
class Filler {
public:
  Filler(const Cylinder& cylinder_, const Filling& filling_)
      : cylinder(cylinder_), filling(filling_), random(static_cast<std::uint64_t>(filling.jitter.seed)) {}

  /// From -1 to 1, the same numbers with every standard library: 53 bits.
  double uniform() { return std::ldexp(static_cast<double>(random() >> 11), -52) - 1; }
  /// Jitter across cell i. Outermost points on the surface stay there: none across a cell that is cut off.
  double shift(const Division& d, std::size_t i) {
    const double cell = d.end[i] - d.begin[i],
                 to_wall = std::min(d.position[i] - d.begin[i], d.end[i] - d.position[i]);
    return (to_wall > 1e-9 * cell ? 0.5 * filling.jitter.amount * cell : 0.0) * uniform();
  }
  /// Cells of one base, `width` wide when whole. place() says where over the base the next point is (x, y).
  template<class Place>
  void add_column(const Division& axial, double base, double width, bool rim, const Place& place) {
    for (std::size_t k = 0; k < axial.size(); ++k) {
      const std::array<double, 2> at = place();
      positions.push_back({at[0], at[1], cylinder.bottom + axial.position[k] + shift(axial, k)});
      cells.push_back({.volume = base * (axial.end[k] - axial.begin[k]),
                       .spacing = std::cbrt(axial.width[k] * width * width),
                       .faces = static_cast<std::uint8_t>((k == 0 ? low_face : 0) |
                                                          (k + 1 == axial.size() ? high_face : 0) |
                                                          (rim ? rim_face : 0))});
    }
  }
  Points points(double density) const {
    const auto order = hilbert_order(positions);
    Points points;
    points.resize(positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const Cell& cell = cells[order[i]];
      points.position.set(i, positions[order[i]]);
      points.volume[i] = cell.volume;
      points.mass[i] = density * cell.volume;
      points.spacing[i] = cell.spacing;
      points.faces[i] = cell.faces;
    }
    points.initial_position = points.position;
    points.surface_offset = filling.boundary == Boundary::on_surface ? 0 : 0.5;
    return points;
  }

private:
  struct Cell {
    double volume, spacing;
    std::uint8_t faces;
  };
  const Cylinder& cylinder;
  const Filling& filling;
  std::mt19937_64 random;
  std::vector<Vec3> positions;
  std::vector<Cell> cells;
};

void fill_rings(Filler& filler, const Cylinder& cylinder, const Filling& filling,
                const SymmetryPlanes& planes) {
  Division radial =
      divide(cylinder.radius - cylinder.hole,
             filling.grading.used() ? ring_widths(cylinder.radius - cylinder.hole, filling.grading)
                                    : std::vector<double>(static_cast<std::size_t>(filling.rings), 1.0),
             Boundary::centred, filling.boundary);
  for (std::vector<double>* r : {&radial.position, &radial.begin, &radial.end})
    for (double& x : *r) x += cylinder.hole;
  for (std::size_t i = 0; i < radial.size(); ++i) {
    const double r = radial.position[i], width = radial.width[i];
    const int around = planes.axis ? 1 : points_on_ring(r, width);
    const double area = pi * (radial.end[i] * radial.end[i] - radial.begin[i] * radial.begin[i]) / around;
    const int more = filling.boundary == Boundary::on_surface ? 1 : 0;
    const int layers = filling.grading.used()
                           ? std::max(1, static_cast<int>(std::lround(cylinder.height / width))) + more
                           : filling.layers;
    const Division axial = stack(cylinder.height, layers, filling.boundary);
    for (int j = 0; j < around; ++j) {
      const double gap = planes.axis ? 0 : 2 * pi / around, angle = gap * (j + 0.5);
      if (!modelled(planes, std::cos(angle), std::sin(angle))) continue;
      filler.add_column(axial, area, width, i + 1 == radial.size(), [&]() -> std::array<double, 2> {
        const double s = r + filler.shift(radial, i),
                     t = angle + 0.5 * filling.jitter.amount * gap * filler.uniform();
        return {s * std::cos(t), s * std::sin(t)};
      });
    }
  }
}

/// Area of the square from (x, y) to (x + h, y + h), x and y >= 0, inside the circle about the origin.
double area_inside(double radius, double x, double y, double h) {
  const auto reach = [radius](double at) { return std::sqrt(std::max(0.0, radius * radius - at * at)); };
  const auto below_arc = [&](double at) {
    return 0.5 * (at * reach(at) + radius * radius * std::asin(std::min(1.0, at / radius)));
  };
  // As far as `full` the arc is above the square, beyond `empty` below it.
  const double full = std::clamp(reach(y + h), x, x + h), empty = std::clamp(reach(y), x, x + h);
  return h * (full - x) + below_arc(empty) - below_arc(full) - y * (empty - full);
}

void fill_lattice(Filler& filler, const Cylinder& cylinder, const Filling& filling,
                  const SymmetryPlanes& planes) {
  const double h = cylinder.radius / filling.rings, whole = h * h;
  const Division axial = stack(cylinder.height, filling.layers, filling.boundary);
  const auto inside = [&](int i, int j) { return std::hypot(i + 0.5, j + 0.5) < filling.rings; };
  const auto area = [&](int i, int j) { return area_inside(cylinder.radius, i * h, j * h, h); };
  const auto cut = [&](int i, int j) { return std::hypot(i + 1, j + 1) > filling.rings; };
  double full = 0, partial = 0; // of a quarter
  for (int i = 0; i < filling.rings; ++i)
    for (int j = 0; j < filling.rings; ++j)
      if (inside(i, j)) (cut(i, j) ? partial : full) += area(i, j);
  const double share = partial > 0 ? (0.25 * pi * cylinder.radius * cylinder.radius - full) / partial : 0;
  const double across = 0.5 * filling.jitter.amount * h;
  for (int i = -filling.rings; i < filling.rings; ++i)
    for (int j = -filling.rings; j < filling.rings; ++j) {
      const double x = h * (i + 0.5), y = h * (j + 0.5);
      const int a = i < 0 ? -i - 1 : i, b = j < 0 ? -j - 1 : j; // the same cell of the first quarter
      if (!inside(a, b) || !modelled(planes, x, y)) continue;
      filler.add_column(axial, cut(a, b) ? share * area(a, b) : whole, h,
                        !inside(a + 1, b) || !inside(a, b + 1), [&]() -> std::array<double, 2> {
                          const double u = x + across * filler.uniform();
                          return {u, y + across * filler.uniform()};
                        });
    }
}

} // namespace

Points fill_cylinder(const Cylinder& cylinder, const Filling& filling, const SymmetryPlanes& planes,
                     double density) {
  Filler filler(cylinder, filling);
  if (filling.layout == Layout::lattice)
    fill_lattice(filler, cylinder, filling, planes);
  else
    fill_rings(filler, cylinder, filling, planes);
  return filler.points(density);
}

} // namespace spall
