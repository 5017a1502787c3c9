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

double coarsest_ligament_element(const CellGeometry& geometry, const GridLines& lines) {
  double coarsest = 0;
  for (std::size_t i = 1; i < lines.x.size(); ++i)
    if (std::abs(0.5 * (lines.x[i] + lines.x[i - 1]) - 0.5) > 0.5 * geometry.crack_ratio)
      coarsest = std::max(coarsest, lines.x[i] - lines.x[i - 1]);
  return coarsest;
}

} // namespace spall
