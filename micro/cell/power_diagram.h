#pragma once

#include <Eigen/Core>

#include <vector>

namespace spall {

/// Convex polygon, corners anticlockwise.
struct PowerCell {
  std::vector<Eigen::Vector2d> corners;
  struct Side {
    int neighbour = 0;   ///< site beyond it
    double distance = 0; ///< of that site's image
  };
  std::vector<Side> sides; ///< side k leads from corner k to the next one
};

/// Power (Laguerre) cells of sites in the unit square that repeats in x and y: cell i holds the points whose
/// |x - site_i|^2 - weight_i is least. Cells are where their sites are, and together fill one period.
std::vector<PowerCell> power_diagram(const std::vector<Eigen::Vector2d>& sites,
                                     const std::vector<double>& weights);

/// Area and centroid of a polygon.
double area(const std::vector<Eigen::Vector2d>& corners);
Eigen::Vector2d centroid(const std::vector<Eigen::Vector2d>& corners);

/// Weights for which the cells have given areas (sum 1): damped Newton of Kitagawa, Merigot and Thibert, J.
/// Eur. Math. Soc. 21 (2019), which converges from any distinct sites.
/// @throws std::runtime_error if it does not (sites on each other)
std::vector<double> weights_for_areas(const std::vector<Eigen::Vector2d>& sites,
                                      const std::vector<double>& areas);

} // namespace spall
