#include "macro/approximation/support.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace spall {

Vec3 Support::half_widths(double radius) const {
  Vec3 half;
  for (int i = 0; i < 3; ++i)
    half[i] = radius * std::sqrt(matrix[3 * i] * matrix[3 * i] + matrix[3 * i + 1] * matrix[3 * i + 1] +
                                 matrix[3 * i + 2] * matrix[3 * i + 2]);
  return half;
}

Support make_support(const Mat3& deformation, double spacing, const SupportInputs& inputs) {
  using RowMatrix = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  const double radius = inputs.normalized_size * spacing;
  RowMatrix F = Eigen::Map<const RowMatrix>(deformation.data());
  // F = W S Z^T through the eigenvectors of F^T F; clipping S leaves the rotation W Z^T alone.
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
  eigen.computeDirect(Eigen::Matrix3d(F.transpose() * F));
  const Eigen::Vector3d stretch = eigen.eigenvalues().cwiseMax(0).cwiseSqrt();
  if (!(stretch[0] > 1e-6) || !std::isfinite(stretch[2])) {
    const double r = radius, i = 1 / radius;
    return {{r, 0, 0, 0, r, 0, 0, 0, r}, {i, 0, 0, 0, i, 0, 0, 0, i}, 1};
  }
  const Eigen::Vector3d clipped = stretch.cwiseMax(inputs.min_stretch).cwiseMin(inputs.max_stretch);
  Support support;
  if (clipped != stretch)
    F = F * eigen.eigenvectors() * clipped.cwiseQuotient(stretch).asDiagonal() *
        eigen.eigenvectors().transpose();
  Eigen::Map<RowMatrix>(support.matrix.data()) = radius * F;
  support.inverse = inverse(support.matrix);
  support.smallest_stretch = clipped.minCoeff();
  return support;
}

} // namespace spall
