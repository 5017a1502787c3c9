#pragma once

#include <Eigen/Core>

#include <vector>

namespace spall {

/// A convex polygon with its corners in anticlockwise order.
struct PowerCell {
  std::vector<Eigen::Vector2d> corners;
  struct Side {
    int neighbour = 0;   ///< number of the site on the other side of the edge
    double distance = 0; ///< distance to the image of that site
  };
  std::vector<Side> sides; ///< side k leads from corner k to the next one
};

/// Returns the power (Laguerre) cells of sites in the unit square, periodic in x and y: cell i holds the
/// points whose |x - site_i|^2 - weight_i is least. Each cell is given at the image of its own site; together
/// the cells fill one period.
std::vector<PowerCell> power_diagram(const std::vector<Eigen::Vector2d>& sites,
                                     const std::vector<double>& weights);

/// Area and centroid of a polygon.
double area(const std::vector<Eigen::Vector2d>& corners);
Eigen::Vector2d centroid(const std::vector<Eigen::Vector2d>& corners);

/// Returns the weights for which the cells have given areas (of sum 1), by the damped Newton method of
/// Kitagawa, Merigot and Thibert, J. Eur. Math. Soc. 21 (2019), which converges for any distinct sites.
/// @throws std::runtime_error if it does not converge (coincident sites)
std::vector<double> weights_for_areas(const std::vector<Eigen::Vector2d>& sites,
                                      const std::vector<double>& areas);

} // namespace spall
