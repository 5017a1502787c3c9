#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace spall {

/// Direction in which a ligament continues from a crack tip.
enum class Ligament {
  joined, ///< straight to the next tip on the line, so that cracks coalesce
  aligned ///< along the crack; periodic only if the tangent of its angle is a ratio of small integers
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
  double length = 0;   ///< relative: each length is uniform in mean * [1 - length, 1 + length]
  double angle = 0;    ///< degrees, each angle uniform in mean + [-angle, angle]
  double position = 0; ///< 0: evenly spaced, 1: anywhere in the crack's share of the line, and up or down by
                       ///< a fifth of the distance between lines
  int seed = 1;
};

/// Straight crack lines from the lower to the upper edge, evenly spaced, which cross all others.
struct VerticalLines {
  int count = 0;
  double crack_ratio = 0; ///< length of the crack in the middle of each over the edge
};

/// Cracks of the square cell of edge 1; the real edge l enters only with the cohesive law, because the linear
/// bulk does not depend on it in 2D. Cracks lie on lines that cross the periodic cell from left to right
/// without meeting each other, and on vertical lines that cross those. The rest of each line is its cohesive
/// ligament.
struct CellGeometry {
  double crack_ratio = 0;            ///< 2 a0 / l of each crack, 0 (no crack) to below 1
  double offset_x = 0, offset_y = 0; ///< of the first line's crack from the centre
  double angle = 0;                  ///< of the cracks against the horizontal, degrees
  Ligament ligament = Ligament::joined;
  int lines = 1;           ///< parallel crack lines, evenly spaced
  int cracks_per_line = 1; ///< evenly spaced along each line, of one row
  RandomCracks random{};
  VerticalLines vertical{};
  CrackShape shape = CrackShape::through; ///< in 3D

  bool is_single_centred() const;
};

/// One crack line over the width of the cell: straight segments between knots.
struct CrackLine {
  struct Knot {
    double x, y;
  };
  std::vector<Knot> knots; ///< x ascending from 0 to 1; the last y is the first plus the rise
  std::vector<bool> open;  ///< per segment: initial crack
  double y(double x) const;
  bool is_open(double x) const;
};

struct CrackLines {
  std::vector<CrackLine> lines;   ///< from the lowest to the highest
  std::vector<double> vertical{}; ///< x of the vertical lines
  double rise = 0; ///< of the cell's lower edge over its width: 0, or the tangent of aligned cracks
};

/// Places the cracks. The same geometry, seed included, always gives the same lines on any machine.
/// @throws std::invalid_argument, saying which number cannot be used and what is allowed: an angle whose line
/// does not repeat, cracks that leave their share of the line, lines that touch.
CrackLines crack_lines(const CellGeometry& geometry);

} // namespace spall
