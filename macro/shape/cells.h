#pragma once

#include "macro/shape/fill.h"

#include <cstdint>
#include <random>
#include <vector>

namespace spall {

/// Cells side by side over a length: points, extents and widths of the whole cells, m.
struct Division {
  std::vector<double> position, begin, end, width;

  std::size_t size() const { return position.size(); }
};

/// Cells of these widths, all scaled by one factor to fill the length. Those at a surface whose point lies on
/// it are halves.
Division divide(double length, const std::vector<double>& widths, Boundary low, Boundary high);
/// Equal cells over a length.
Division divide(double length, int cells, Boundary boundary);
/// How many cells of about this spacing fill a length: at least one.
int nearest_count(double length, double spacing);
/// Division of a width about zero into an even number of cells. Positions are measured from its lower end.
Division divide_evenly(double width, const Filling& filling);

/// Whether a place lies on the modelled side of the symmetry planes.
bool is_modelled(const SymmetryPlanes& planes, double x, double y);

/// What a point knows of its cell.
struct Cell {
  double volume, spacing; ///< m^3, m
  std::uint8_t faces;     ///< bits of Face
};

/// Points at rest at the centres of these cells, Hilbert-ordered.
/// @param surface_offset from the outermost points to the surface, in spacings
Points points_of(const std::vector<Vec3>& positions, const std::vector<Cell>& cells, double density,
                 double surface_offset);

/// Collects the cells of a body, column by column over the height.
class Filler {
public:
  /// @param bottom_ z of the lower end of the columns, m
  Filler(double bottom_, const Filling& filling_)
      : bottom(bottom_), filling(filling_), random(static_cast<std::uint64_t>(filling.jitter.seed)) {}

  /// From -1 to 1, the same numbers with every standard library: 53 bits.
  double uniform() { return std::ldexp(static_cast<double>(random() >> 11), -52) - 1; }
  /// Jitter across cell i. Outermost points on the surface stay there: none across a cell that is cut off.
  double shift(const Division& d, std::size_t i);
  /// Cells of one base area, `width` wide when whole. place() says where over the base the next point is (x,
  /// y).
  template<class Place>
  void add_column(const Division& axial, double base, double width, bool rim, const Place& place) {
    for (std::size_t k = 0; k < axial.size(); ++k) {
      const std::array<double, 2> at = place();
      positions.push_back({at[0], at[1], bottom + axial.position[k] + shift(axial, k)});
      cells.push_back({.volume = base * (axial.end[k] - axial.begin[k]),
                       .spacing = std::cbrt(axial.width[k] * width * width),
                       .faces = static_cast<std::uint8_t>((k == 0 ? low_face : 0) |
                                                          (k + 1 == axial.size() ? high_face : 0) |
                                                          (rim ? rim_face : 0))});
    }
  }
  Points points(double density) const {
    return points_of(positions, cells, density, filling.boundary == Boundary::on_surface ? 0 : 0.5);
  }

private:
  double bottom;
  const Filling& filling;
  std::mt19937_64 random;
  std::vector<Vec3> positions;
  std::vector<Cell> cells;
};

} // namespace spall
