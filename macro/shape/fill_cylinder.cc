#include "macro/shape/cells.h"

#include <algorithm>
#include <numbers>

namespace spall {
namespace {

using std::numbers::pi;

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
    const Division axial = divide(cylinder.height, layers, filling.boundary);
    for (int j = 0; j < around; ++j) {
      const double gap = planes.axis ? 0 : 2 * pi / around, angle = gap * (j + 0.5);
      if (!is_modelled(planes, std::cos(angle), std::sin(angle))) continue;
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
  const Division axial = divide(cylinder.height, filling.layers, filling.boundary);
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
      if (!inside(a, b) || !is_modelled(planes, x, y)) continue;
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
  Filler filler(cylinder.bottom, filling);
  if (filling.layout == Layout::lattice)
    fill_lattice(filler, cylinder, filling, planes);
  else
    fill_rings(filler, cylinder, filling, planes);
  return filler.points(density);
}

} // namespace spall
