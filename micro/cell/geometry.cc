#include "micro/cell/geometry.h"

#include <algorithm>
#include <cmath>

namespace spall {
namespace {

/// Returns graded distances from a tip into a segment, without 0 and with the segment's length.
std::vector<double> graded(double length, const MeshDensity& density) {
  const int count = std::max(
      1, static_cast<int>(std::lround(density.elements * std::pow(2 * length, 1 / density.grading))));
  std::vector<double> distances;
  for (int i = 1; i <= count; ++i)
    distances.push_back(length * std::pow(static_cast<double>(i) / count, density.grading));
  return distances;
}

/// Mirrors distances about the centre line 1/2; the first and the last line are exactly 0 and 1.
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

const std::vector<std::pair<std::string, ElementKind>>& element_words() {
  static const std::vector<std::pair<std::string, ElementKind>> words = {
      {"continuous", ElementKind::continuous}, {"discontinuous", ElementKind::discontinuous}};
  return words;
}

GridLines grid_lines(const CellGeometry& geometry, const MeshDensity& density) {
  const double tip = 0.5 * geometry.crack_ratio; // distance of the tip from the centre
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

/// Returns the x of the columns: every knot of every line, and columns in between that are graded towards the
/// knots on both sides. There is no grading towards the edges of the cell.
std::vector<double> columns(const CrackLines& set, const MeshDensity& density) {
  std::vector<double> knots;
  for (const CrackLine& line : set.lines)
    for (const auto& knot : line.knots) knots.push_back(knot.x);
  knots.insert(knots.end(), set.vertical.begin(), set.vertical.end());
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

/// Returns the rows between two crack lines `gap` apart, as shares of the gap, without the lines themselves.
/// Rows are graded towards the lines and the tips (given as shares) of vertical cracks, not towards the edges
/// of the cell.
std::vector<double> strip(double gap, std::vector<double> tips, bool line_below, bool line_above,
                          const MeshDensity& density) {
  tips.insert(tips.begin(), 0);
  tips.push_back(1);
  std::vector<double> rows;
  for (std::size_t i = 1; i < tips.size(); ++i) {
    const double a = tips[i - 1], b = tips[i], width = (b - a) * gap;
    const bool lower = i > 1 || line_below, upper = i + 1 < tips.size() || line_above;
    const std::vector<double> steps = graded((lower && upper ? 0.5 : 1.0) * width, density);
    for (std::size_t k = 0; lower && k + 1 < steps.size(); ++k) rows.push_back(a + steps[k] / gap);
    if (lower && upper) rows.push_back(0.5 * (a + b));
    for (std::size_t k = steps.size() - 1; upper && k-- > 0;) rows.push_back(b - steps[k] / gap);
    if (i + 1 < tips.size()) rows.push_back(b);
  }
  return rows;
}

/// Returns the height of row y at one of the columns x.
double height(const std::vector<double>& x, const std::vector<double>& y, double at) {
  return y[static_cast<std::size_t>(std::lower_bound(x.begin(), x.end(), at - 1e-9) - x.begin())];
}

/// Returns the tips of vertical cracks between two rows, as shares of the rows' distance, ascending.
std::vector<double> tips_between(const std::vector<double>& x, const std::vector<double>& below,
                                 const std::vector<double>& above, const CellGeometry& geometry,
                                 const CrackLines& set) {
  std::vector<double> tips;
  for (const double at : set.vertical)
    for (const double side : {-0.5, 0.5}) {
      const double y = 0.5 + set.rise * at + side * geometry.vertical.crack_ratio;
      const double low = height(x, below, at), share = (y - low) / (height(x, above, at) - low);
      if (geometry.vertical.crack_ratio > 0 && share > 1e-9 && share < 1 - 1e-9) tips.push_back(share);
    }
  std::sort(tips.begin(), tips.end());
  tips.erase(std::unique(tips.begin(), tips.end(), [](double a, double b) { return b - a < 1e-9; }),
             tips.end());
  return tips;
}

void add_vertical_lines(CellGrid& grid, const CellGeometry& geometry, const CrackLines& set) {
  for (const double at : set.vertical) {
    GridColumn column{.line = static_cast<int>(set.lines.size() + grid.vertical.size()), .open = {}};
    while (grid.x[column.at] < at - 1e-9) ++column.at;
    for (std::size_t row = 1; row < grid.rows.size(); ++row) {
      const double middle = 0.5 * (grid.rows[row - 1].y[column.at] + grid.rows[row].y[column.at]);
      column.open.push_back(std::abs(middle - 0.5 - set.rise * at) < 0.5 * geometry.vertical.crack_ratio);
    }
    grid.vertical.push_back(column);
  }
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
    const auto mean_gap = [&](const std::vector<double>& from, const std::vector<double>& to) {
      double sum = 0;
      for (std::size_t i = 1; i < grid.x.size(); ++i)
        sum += 0.5 * (to[i] - from[i] + to[i - 1] - from[i - 1]) * (grid.x[i] - grid.x[i - 1]);
      return sum;
    };
    std::vector<double> below;
    for (const double x : grid.x) below.push_back(set.rise * x);
    grid.rows.push_back({.y = below});
    for (std::size_t k = 0; k <= set.lines.size(); ++k) {
      const bool first = k == 0, last = k == set.lines.size();
      std::vector<double> above;
      for (const double x : grid.x) above.push_back(last ? 1 + set.rise * x : set.lines[k].y(x));
      const std::vector<double> tips = tips_between(grid.x, below, above, geometry, set);
      for (const double share : strip(mean_gap(below, above), tips, !first, !last, density)) {
        std::vector<double> y;
        for (std::size_t i = 0; i < below.size(); ++i) y.push_back(below[i] + share * (above[i] - below[i]));
        grid.rows.push_back({.y = y});
      }
      grid.rows.push_back({.y = above, .line = last ? -1 : static_cast<int>(k)});
      below = above;
    }
    add_vertical_lines(grid, geometry, set);
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
  for (const GridColumn& column : grid.vertical)
    for (std::size_t i = 1; i < grid.rows.size(); ++i)
      if (!column.open[i - 1])
        coarsest = std::max(coarsest, grid.rows[i].y[column.at] - grid.rows[i - 1].y[column.at]);
  return coarsest;
}

} // namespace spall
