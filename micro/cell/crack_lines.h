#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace spall {

/// The direction in which the ligament continues from a crack tip.
enum class Ligament {
  joined, ///< the ligament runs straight to the next tip on the line, so that cracks coalesce
  aligned ///< the ligament continues in the crack's direction; it is periodic only if the tangent of the
          ///< crack's angle is a ratio of small integers
};
const std::vector<std::pair<std::string, Ligament>>& ligament_words();

/// Shape of the initial cracks of a 3D cell.
enum class CrackShape {
  through, ///< the cracks of the plane cell, extended along z
  penny    ///< one circular crack in the middle plane y = 1/2
};
const std::vector<std::pair<std::string, CrackShape>>& shape_words();

/// Scatter of a random family of cracks; all zeros: a regular family.
struct RandomCracks {
  /// Relative scatter: each crack length is drawn uniformly from mean * [1 - length, 1 + length].
  double length = 0;
  double angle = 0; ///< scatter in degrees: each angle is drawn uniformly from mean + [-angle, angle]
  /// Scatter of the crack's position. 0: cracks are evenly spaced; 1: a crack lies anywhere in its share of
  /// the line, and up to a fifth of the distance between lines above or below it.
  double position = 0;
  int seed = 1;
};

/// Straight, evenly spaced crack lines from the lower to the upper edge of the cell, which cross all other
/// crack lines.
struct VerticalLines {
  int count = 0;
  double crack_ratio = 0; ///< length of the initial crack in the middle of each line over the cell's edge
};

/// Cracks of the square cell of edge 1; the real edge l enters only with the cohesive law, because the linear
/// bulk does not depend on it in 2D. Cracks lie on lines that cross the periodic cell from left to right
/// without meeting each other, and on vertical lines that cross those. The rest of each line is its cohesive
/// ligament.
struct CellGeometry {
  double crack_ratio = 0; ///< 2 a0 / l of each crack, 0 (no crack) to below 1
  /// Distance of the first line's crack from the centre, in units of the edge.
  double offset_x = 0, offset_y = 0;
  double angle = 0; ///< angle between the cracks and the horizontal, degrees
  Ligament ligament = Ligament::joined;
  int lines = 1;           ///< number of parallel, evenly spaced crack lines
  int cracks_per_line = 1; ///< number of initial cracks on each line, evenly spaced along it
  RandomCracks random{};
  VerticalLines vertical{};
  CrackShape shape = CrackShape::through; ///< shape of the initial cracks in 3D

  bool is_single_centred() const;
};

/// One crack line over the width of the cell: a polyline of straight segments between knots.
struct CrackLine {
  struct Knot {
    double x, y;
  };
  std::vector<Knot> knots; ///< knots with x ascending from 0 to 1; the last y is the first one plus the rise
  std::vector<bool> open;  ///< for each segment: whether it is an initial crack
  double y(double x) const;
  bool is_open(double x) const;
};

struct CrackLines {
  /// Crack lines that cross the cell from left to right, from the lowest to the highest.
  std::vector<CrackLine> lines;
  std::vector<double> vertical{}; ///< x of the vertical lines
  /// Rise of the cell's lower edge over its width: 0, or the tangent of the angle of aligned cracks.
  double rise = 0;
};

/// Places the cracks. The same geometry, seed included, always gives the same lines on any machine.
/// @throws std::invalid_argument naming the number that cannot be used and what is allowed: an angle whose
/// line is not periodic, cracks that leave their share of the line, lines that touch.
CrackLines crack_lines(const CellGeometry& geometry);

} // namespace spall
