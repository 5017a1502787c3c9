#include "macro/shape/cells.h"

#include "macro/points/order.h"

#include <algorithm>

namespace spall {

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

Division divide(double length, int cells, Boundary boundary) {
  return divide(length, std::vector<double>(static_cast<std::size_t>(cells), 1.0), boundary, boundary);
}

int nearest_count(double length, double spacing) {
  return std::max(1, static_cast<int>(std::lround(length / spacing)));
}

Division divide_evenly(double width, const Filling& filling) {
  const int more = filling.boundary == Boundary::on_surface ? 1 : 0; // one spacing less than points
  return divide(width, 2 * nearest_count(width + more * filling.spacing, 2 * filling.spacing),
                filling.boundary);
}

bool is_modelled(const SymmetryPlanes& planes, double x, double y) {
  return !(planes.normal[0] && x < 0) && !(planes.normal[1] && y < 0);
}

Points points_of(const std::vector<Vec3>& positions, const std::vector<Cell>& cells, double density,
                 double surface_offset) {
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
  points.surface_offset = surface_offset;
  return points;
}

double Filler::shift(const Division& d, std::size_t i) {
  const double cell = d.end[i] - d.begin[i],
               to_wall = std::min(d.position[i] - d.begin[i], d.end[i] - d.position[i]);
  return (to_wall > 1e-9 * cell ? 0.5 * filling.jitter.amount * cell : 0.0) * uniform();
}

} // namespace spall
