#include "micro/cell/geometry.h"

#include <algorithm>
#include <cmath>

namespace spall {
namespace {

/// Distances from a tip into a segment, excluding 0 and including its length.
std::vector<double> graded(double length, const MeshDensity& density) {
  const int count = std::max(
      1, static_cast<int>(std::lround(density.elements * std::pow(2 * length, 1 / density.grading))));
  std::vector<double> distances;
  for (int i = 1; i <= count; ++i)
    distances.push_back(length * std::pow(static_cast<double>(i) / count, density.grading));
  return distances;
}

/// Mirrors distances from the centre line 1/2 to both sides; 0 and 1 are hit exactly.
std::vector<double> mirrored(std::vector<double> from_centre) {
  std::sort(from_centre.begin(), from_centre.end());
  std::vector<double> lines;
  for (auto d = from_centre.rbegin(); d != from_centre.rend(); ++d) lines.push_back(0.5 - *d);
  lines.push_back(0.5);
  for (const double d : from_centre) lines.push_back(0.5 + d);
  lines.front() = 0;
  lines.back() = 1;
  return lines;
}

} // namespace

GridLines grid_lines(const CellGeometry& geometry, const MeshDensity& density) {
  const double tip = 0.5 * geometry.crack_ratio; // from the centre
  std::vector<double> x;
  if (tip == 0) {
    x = graded(0.5, {.elements = density.elements, .grading = 1});
  } else {
    for (const double d : graded(tip, density))
      if (d < tip) x.push_back(tip - d);
    x.push_back(tip);
    for (const double d : graded(0.5 - tip, density)) x.push_back(tip + d);
  }
  return {.x = mirrored(x), .y = mirrored(graded(0.5, density))};
}

namespace {

/// Columns: every knot of every line, and graded towards knots from both sides in between. The edges of the
/// cell attract nothing.
std::vector<double> columns(const CrackLines& set, const MeshDensity& density) {
  std::vector<double> knots;
  for (const CrackLine& line : set.lines)
    for (const auto& knot : line.knots) knots.push_back(knot.x);
  std::sort(knots.begin(), knots.end());
  constexpr double same = 1e-9;
  knots.erase(std::unique(knots.begin(), knots.end(), [](double a, double b) { return b - a < same; }),
              knots.end());
  knots.back() = 1;
  if (knots.size() == 2) { // no tip
    std::vector<double> x;
    for (int i = 0; i <= 2 * density.elements; ++i) x.push_back(0.5 * i / density.elements);
    return x;
  }
  std::vector<double> x = {0};
  for (std::size_t i = 1; i < knots.size(); ++i) {
    const double a = knots[i - 1], b = knots[i];
    const bool left = i > 1, right = i + 1 < knots.size();
    const double middle = left && right ? 0.5 * (a + b) : left ? b : a;
    if (left)
      for (const double d : graded(middle - a, density)) x.push_back(a + d);
    if (right) {
      std::vector<double> distances = graded(b - middle, density);
      distances.pop_back();
      std::reverse(distances.begin(), distances.end());
      for (const double d : distances) x.push_back(b - d);
    }
    if (x.back() < b) x.push_back(b);
    x.back() = b;
  }
  return x;
}

} // namespace

CellGrid cell_grid(const CellGeometry& geometry, const MeshDensity& density) {
  CellGrid grid;
  const CrackLines set = crack_lines(geometry);
  if (geometry.is_single_centred()) {
    const GridLines lines = grid_lines(geometry, density);
    grid.x = lines.x;
    for (const double y : lines.y)
      grid.rows.push_back({.y = std::vector<double>(grid.x.size(), y), .line = y == 0.5 ? 0 : -1});
  } else {
    grid.x = columns(set, density);
    grid.rise = set.rise;
    const auto base = [&](double height) {
      std::vector<double> y;
      for (const double x : grid.x) y.push_back(height + set.rise * x);
      return y;
    };
    const auto blend = [&](const std::vector<double>& from, const std::vector<double>& to, double share) {
      std::vector<double> y;
      for (std::size_t i = 0; i < from.size(); ++i) y.push_back(from[i] + share * (to[i] - from[i]));
      return y;
    };
    const auto mean_gap = [&](const std::vector<double>& from, const std::vector<double>& to) {
      double sum = 0;
      for (std::size_t i = 1; i < grid.x.size(); ++i)
        sum += 0.5 * (to[i] - from[i] + to[i - 1] - from[i - 1]) * (grid.x[i] - grid.x[i - 1]);
      return sum;
    };
    std::vector<double> below = base(0);
    grid.rows.push_back({.y = below});
    for (std::size_t k = 0; k <= set.lines.size(); ++k) {
      std::vector<double> above;
      const bool first = k == 0, last = k == set.lines.size();
      if (last)
        above = base(1);
      else
        for (const double x : grid.x) above.push_back(set.lines[k].y(x));
      // From a line upwards to half of the gap, then downwards from the next one; edges attract nothing.
      const double gap = mean_gap(below, above), half = first || last ? 1.0 : 0.5;
      const std::vector<double> steps = graded(half * gap, density);
      if (!first)
        for (std::size_t i = 0; i + 1 < steps.size(); ++i)
          grid.rows.push_back({.y = blend(below, above, steps[i] / gap)});
      if (!first && !last) grid.rows.push_back({.y = blend(below, above, 0.5)});
      if (!last)
        for (std::size_t i = steps.size() - 1; i-- > 0;)
          grid.rows.push_back({.y = blend(above, below, steps[i] / gap)});
      grid.rows.push_back({.y = above, .line = last ? -1 : static_cast<int>(k)});
      below = above;
    }
  }
  for (const CrackLine& line : set.lines) {
    grid.open.emplace_back();
    for (std::size_t i = 1; i < grid.x.size(); ++i)
      grid.open.back().push_back(line.is_open(0.5 * (grid.x[i] + grid.x[i - 1])));
  }
  return grid;
}

double coarsest_ligament_element(const CellGrid& grid) {
  double coarsest = 0;
  for (const GridRow& row : grid.rows)
    for (std::size_t i = 1; row.line >= 0 && i < grid.x.size(); ++i)
      if (!grid.open[row.line][i - 1])
        coarsest = std::max(coarsest, std::hypot(grid.x[i] - grid.x[i - 1], row.y[i] - row.y[i - 1]));
  return coarsest;
}

} // namespace spall
