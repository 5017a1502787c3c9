#pragma once

#include <Eigen/Core>

#include <string>
#include <utility>
#include <vector>

namespace spall {

/// Aggregates of a cell, as seen in a section. The passing share by area is
///   (d^n - d_min^n) / (d_max^n - d_min^n),
/// Fuller's curve (n = 1/2) cut at the smallest diameter that is modelled; finer ones belong to the mortar.
struct Grading {
  double fraction = 0; ///< area of the aggregates over that of the cell; 0: no aggregates
  double smallest = 0; ///< d_min, m
  double largest = 0;  ///< d_max, m
  double exponent = 0.5;
};

/// Diameters of the circles of equal area, largest first, in units of the cell's edge. Each stands for an
/// equal share of the number of aggregates that the grading has in a cell of this size, and holds the area of
/// its share, so that every cell has exactly the given fraction and grading.
std::vector<double> aggregate_diameters(const Grading& grading, double cell_size);

/// Where mortar may crack between aggregates.
enum class MortarCracks {
  none,             ///< nowhere: aggregates debond only
  corners,          ///< from the corners of the aggregates to where mortar rings meet
  corners_and_flats ///< and from the middle of their sides straight to the neighbour's
};
const std::vector<std::pair<std::string, MortarCracks>>& mortar_crack_words();

/// An aggregate with its ring of mortar: a polygon, and inside it the aggregate, a similar polygon scaled
/// towards the centre.
struct Aggregate {
  std::vector<Eigen::Vector2d> corners; ///< of the mortar's outer edge, anticlockwise
  Eigen::Vector2d centre;
  double scale = 0; ///< of the aggregate's corners: centre + scale (corner - centre)
};

/// Packs aggregates into the unit cell that repeats: the polygons are power cells round random sites, moved
/// to the centres of their cells a few times, with areas in proportion to the aggregates'. They fill one
/// period with a ragged border; shared corners are equal up to a period. The same seed gives the same cell.
/// @throws std::runtime_error where they cannot be packed
std::vector<Aggregate> place_aggregates(const std::vector<double>& diameters, int seed);

/// Longest element side that may crack, of the interface zone and of the mortar, in units of the cell's edge.
struct LongestSides {
  double interface_zone = 0, mortar = 0;
};
LongestSides longest_sides(const std::vector<Aggregate>& aggregates, int refinements);

} // namespace spall
