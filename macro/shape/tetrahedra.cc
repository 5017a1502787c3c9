#include "macro/shape/tetrahedra.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

namespace spall {
namespace {

/// Products of inertia below this part of the moments are round-off of the single precision of STL files:
/// then the axes of the frame are those of inertia.
constexpr double negligible_product = 1e-6;

using Axes = Eigen::Matrix3d;

/// Principal axes as the columns of a rotation, each in the place of the frame's axis that is nearest to it.
Axes sorted(const Axes& axes) {
  constexpr std::array<std::array<int, 3>, 6> orders = {
      {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
  Axes best = axes;
  double most = -1;
  for (const auto& order : orders) {
    Axes candidate;
    for (int c = 0; c < 3; ++c) {
      candidate.col(c) = axes.col(order[c]);
      if (candidate(c, c) < 0) candidate.col(c) *= -1;
    }
    if (candidate.trace() > most) most = candidate.trace(), best = candidate;
  }
  if (best.determinant() < 0) {
    int least = 0; // the axis that is farthest from the frame's points either way
    for (int c = 1; c < 3; ++c)
      if (best(c, c) < best(least, least)) least = c;
    best.col(least) *= -1;
  }
  return best;
}

} // namespace

MassProperties solid_inside(const Triangles& surface, const Vec3& amid) {
  double volume = 0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Axes second = Axes::Zero();
  for (std::size_t f = 0; f < surface.corners.size(); ++f) {
    Axes corners; // in its columns
    const std::array<Vec3, 3> triangle = surface.triangle(f);
    for (int k = 0; k < 3; ++k)
      for (int c = 0; c < 3; ++c) corners(c, k) = triangle[k][c] - amid[c];
    const double v = corners.determinant() / 6;
    const Eigen::Vector3d sum = corners.rowwise().sum();
    volume += v;
    first += 0.25 * v * sum;
    second += v / 20 * (corners * corners.transpose() + sum * sum.transpose());
  }
  const Eigen::Vector3d centre = first / volume;
  const Axes spread = second / volume - centre * centre.transpose();
  const Axes inertia = spread.trace() * Axes::Identity() - spread; // per mass

  MassProperties p{.volume = volume, .centre = amid + Vec3{centre[0], centre[1], centre[2]}};
  const Axes products = inertia - Axes(inertia.diagonal().asDiagonal());
  if (products.cwiseAbs().maxCoeff() <= negligible_product * inertia.trace()) {
    p.moments = {inertia(0, 0), inertia(1, 1), inertia(2, 2)};
    return p;
  }
  const Axes axes = sorted(Eigen::SelfAdjointEigenSolver<Axes>(inertia).eigenvectors());
  const Axes principal = axes.transpose() * inertia * axes;
  p.moments = {principal(0, 0), principal(1, 1), principal(2, 2)};
  const Eigen::Quaterniond q(axes);
  p.axes = {q.w(), q.x(), q.y(), q.z()};
  return p;
}

} // namespace spall
