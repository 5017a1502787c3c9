#pragma once

#include <Eigen/Core>

#include <string>
#include <utility>
#include <vector>

namespace spall {

/// The grading curve of the aggregates in a plane section of the cell. The share of the aggregate area with
/// diameters below d is
///   (d^n - d_min^n) / (d_max^n - d_min^n),
/// which is Fuller's curve (n = 1/2) cut at the smallest diameter that is modelled; finer aggregates belong
/// to the mortar.
struct Grading {
  double fraction = 0; ///< area of the aggregates over that of the cell; 0: no aggregates
  double smallest = 0; ///< d_min, m
  double largest = 0;  ///< d_max, m
  double exponent = 0.5;
};

/// Returns the aggregates' equivalent diameters (of circles of equal area), largest first, in units of the
/// cell's edge. The number of aggregates is the one that the grading curve gives for a cell of this size. The
/// curve is divided into that many classes with equal numbers, and each aggregate gets the whole area of its
/// class, so that every cell has exactly the given area fraction and grading.
std::vector<double> aggregate_diameters(const Grading& grading, double cell_size);

/// Paths along which the mortar between aggregates may crack.
enum class MortarCracks {
  none,             ///< the mortar does not crack; aggregates can only debond
  corners,          ///< cracks run from the corners of the aggregates to the points where mortar rings meet
  corners_and_flats ///< in addition, cracks run from the middle of each side straight to the neighbouring
                    ///< aggregate
};
const std::vector<std::pair<std::string, MortarCracks>>& mortar_crack_words();

/// An aggregate with its ring of mortar: a polygon, and inside it the aggregate, a similar polygon scaled
/// towards the centre.
struct Aggregate {
  std::vector<Eigen::Vector2d> corners; ///< corners of the mortar ring's outer edge, anticlockwise
  Eigen::Vector2d centre;
  double scale = 0; ///< size of the aggregate over that of the whole polygon: its corners are centre + scale
                    ///< (corner - centre)
};

/// Packs aggregates into the periodic unit cell. The polygons are the cells of a power diagram with areas in
/// proportion to the aggregates'; its sites are random and are moved to the centroids of their cells a few
/// times (Lloyd iterations). Together the polygons fill one period, whose border follows the polygons;
/// corners that polygons share are equal up to a period. The same seed gives the same packing. @throws
/// std::runtime_error if the aggregates cannot be packed
std::vector<Aggregate> place_aggregates(const std::vector<double>& diameters, int seed);

/// The longest element sides that may crack, in units of the cell's edge.
struct LongestSides {
  double interface_zone = 0, mortar = 0;
};
LongestSides longest_sides(const std::vector<Aggregate>& aggregates, int refinements);

} // namespace spall
