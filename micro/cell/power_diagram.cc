#include "micro/cell/power_diagram.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace spall {
namespace {

using Eigen::Vector2d;

double cross(const Vector2d& a, const Vector2d& b) { return a[0] * b[1] - a[1] * b[0]; }

/// Clips the cell to the half plane normal.x <= offset; `side` describes the new side.
void clip(PowerCell& cell, const Vector2d& normal, double offset, PowerCell::Side side) {
  PowerCell result;
  const std::size_t n = cell.corners.size();
  for (std::size_t k = 0; k < n; ++k) {
    const Vector2d &a = cell.corners[k], &b = cell.corners[(k + 1) % n];
    const double beyond_a = normal.dot(a) - offset, beyond_b = normal.dot(b) - offset;
    if (beyond_a <= 0) {
      result.corners.push_back(a);
      result.sides.push_back(cell.sides[k]);
    }
    if ((beyond_a <= 0) != (beyond_b <= 0)) {
      result.corners.push_back(a + beyond_a / (beyond_a - beyond_b) * (b - a));
      result.sides.push_back(beyond_a <= 0 ? side : cell.sides[k]);
    }
  }
  cell = std::move(result);
}

} // namespace

std::vector<PowerCell> power_diagram(const std::vector<Vector2d>& sites, const std::vector<double>& weights) {
  std::vector<PowerCell> cells;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    // The periodic images of the site itself bound its cell by a square, for any weights.
    const Vector2d& site = sites[i];
    PowerCell cell;
    for (const auto& [x, y] : {std::pair{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}})
      cell.corners.push_back(site + Vector2d(x, y));
    cell.sides.assign(4, {static_cast<int>(i), 1});
    for (std::size_t j = 0; j < sites.size(); ++j)
      for (int right = -1; right <= 1; ++right)
        for (int up = -1; up <= 1; ++up) {
          if (j == i) continue;
          Vector2d away = sites[j] - site; // to the nearest image and those around it
          away -= away.array().round().matrix();
          away += Vector2d(right, up);
          // |x - a|^2 - w_a <= |x - b|^2 - w_b
          const double offset = site.dot(away) + 0.5 * (away.squaredNorm() + weights[i] - weights[j]);
          clip(cell, away, offset, {static_cast<int>(j), away.norm()});
        }
    cells.push_back(std::move(cell));
  }
  return cells;
}

double area(const std::vector<Vector2d>& corners) {
  double sum = 0;
  for (std::size_t k = 0; k < corners.size(); ++k)
    sum += 0.5 * cross(corners[k] - corners[0], corners[(k + 1) % corners.size()] - corners[0]);
  return sum;
}

Vector2d centroid(const std::vector<Vector2d>& corners) {
  Vector2d sum = Vector2d::Zero();
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vector2d a = corners[k] - corners[0], b = corners[(k + 1) % corners.size()] - corners[0];
    sum += cross(a, b) / 6 * (a + b);
  }
  return corners[0] + sum / area(corners);
}

std::vector<double> weights_for_areas(const std::vector<Vector2d>& sites, const std::vector<double>& areas) {
  const auto n = static_cast<Eigen::Index>(sites.size());
  std::vector<double> weights(sites.size(), 0);
  const auto missing = [&](const std::vector<PowerCell>& cells) {
    Eigen::VectorXd result(n);
    for (Eigen::Index i = 0; i < n; ++i) result[i] = areas[i] - area(cells[i].corners);
    return result;
  };
  std::vector<PowerCell> cells = power_diagram(sites, weights);
  Eigen::VectorXd defect = missing(cells);
  double least = *std::min_element(areas.begin(), areas.end());
  for (const PowerCell& cell : cells) least = std::min(least, area(cell.corners));
  constexpr double exact = 1e-13;
  for (int iteration = 0; iteration < 200 && defect.cwiseAbs().maxCoeff() > exact; ++iteration) {
    // d area_i / d weight_j = - length of the common side / (2 distance of the sites).
    Eigen::MatrixXd slope = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index i = 0; i < n; ++i)
      for (std::size_t k = 0; k < cells[i].corners.size(); ++k) {
        const auto [j, distance] = cells[i].sides[k];
        if (j == i) continue; // the weights of the site's own images change alike
        const auto& corners = cells[i].corners;
        const Vector2d side = corners[(k + 1) % corners.size()] - corners[k];
        slope(i, i) += 0.5 * side.norm() / distance;
        slope(i, j) -= 0.5 * side.norm() / distance;
      }
    // Weights are determined up to a constant: the first one is result.
    Eigen::VectorXd step = Eigen::VectorXd::Zero(n);
    if (n > 1) step.tail(n - 1) = slope.bottomRightCorner(n - 1, n - 1).ldlt().solve(defect.tail(n - 1));
    bool improved = false;
    for (double share = 1; share > 1e-6 && !improved; share *= 0.5) {
      std::vector<double> tried = weights;
      for (Eigen::Index i = 0; i < n; ++i) tried[i] += share * step[i];
      std::vector<PowerCell> next = power_diagram(sites, tried);
      const Eigen::VectorXd left = missing(next);
      improved = left.norm() <= (1 - 0.5 * share) * defect.norm() || left.cwiseAbs().maxCoeff() <= exact;
      for (const PowerCell& cell : next) improved = improved && area(cell.corners) >= 0.5 * least;
      if (!improved) continue;
      weights = tried;
      cells = std::move(next);
      defect = left;
    }
    if (!improved) break;
  }
  constexpr double enough = 1e-9;
  if (defect.cwiseAbs().maxCoeff() > enough)
    throw std::runtime_error("the weights of power cells with the given areas were not found");
  return weights;
}

} // namespace spall
