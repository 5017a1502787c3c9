#include "macro/approximation/support.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace spall {
namespace {

Support sphere(double r, double smallest_stretch, SupportShape shape) {
  return {.matrix = r * identity3,
          .inverse = 1 / r * identity3,
          .smallest_stretch = smallest_stretch,
          .box = shape == SupportShape::box};
}

} // namespace

Vec3 Support::half_widths(double radius) const {
  Vec3 half;
  for (int i = 0; i < 3; ++i) {
    const Vec3 a = row(matrix, i);
    half[i] = radius * (box ? std::abs(a[0]) + std::abs(a[1]) + std::abs(a[2]) : norm(a));
  }
  return half;
}

Support make_support(const Mat3& deformation, double spacing, const SupportInputs& inputs) {
  using RowMatrix = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  const double radius = inputs.normalized_size * spacing;
  RowMatrix F = Eigen::Map<const RowMatrix>(deformation.components.data());
  // F = W S Z^T through the eigenvectors of F^T F; clipping S leaves the rotation W Z^T alone.
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
  eigen.computeDirect(Eigen::Matrix3d(F.transpose() * F));
  const Eigen::Vector3d stretch = eigen.eigenvalues().cwiseMax(0).cwiseSqrt();
  if (!(stretch[0] > 1e-6) || !std::isfinite(stretch[2])) return sphere(radius, 1, inputs.shape);
  const Eigen::Vector3d clipped = stretch.cwiseMax(inputs.min_stretch).cwiseMin(inputs.max_stretch);
  if (inputs.shape == SupportShape::sphere) return sphere(radius, clipped.minCoeff(), inputs.shape);
  Support support;
  support.box = inputs.shape == SupportShape::box;
  if (clipped != stretch)
    F = F * eigen.eigenvectors() * clipped.cwiseQuotient(stretch).asDiagonal() *
        eigen.eigenvectors().transpose();
  Eigen::Map<RowMatrix>(support.matrix.components.data()) = radius * F;
  support.inverse = inverse(support.matrix);
  support.smallest_stretch = clipped.minCoeff();
  return support;
}

} // namespace spall
