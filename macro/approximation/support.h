#pragma once

#include "macro/points/points.h"

#include <string>
#include <utility>

namespace spall {

enum class SupportShape {
  ellipsoid, ///< follows the deformation
  sphere,    ///< keeps radius and orientation; so does the nodal cell
  box        ///< follows the deformation; product of three kernels along the material's axes
};
inline const std::vector<std::pair<std::string, SupportShape>> support_shape_names = {
    {"ellipsoid", SupportShape::ellipsoid}, {"sphere", SupportShape::sphere}, {"box", SupportShape::box}};

/// Size and shape of the kernel support.
struct SupportInputs {
  SupportShape shape = SupportShape::ellipsoid;
  double normalized_size = 2.0; ///< radius in undeformed spacings
  double min_stretch = 0.5;     ///< principal stretches the support follows, lower clip
  double max_stretch = 8.0;     ///< upper clip
};

/// Support of one evaluation point: x_J is inside if |xi| < 1, xi = inverse (x_J - x_I). Without
/// clipping matrix = a h F, so that xi are the coordinates of the undeformed body in units of the support
/// radius a h: the ellipsoid has the axes of the left stretch V (paper Eq. 8 with a support measure that
/// follows the deformation), and xi turns with the material, so that quantities tied to a direction xi_k need
/// no rotation. A sphere has matrix = a h.
struct Support {
  Mat3 matrix;             ///< m
  Mat3 inverse;            ///< inverse of the matrix, 1/m
  double smallest_stretch; ///< smallest principal stretch of the deformation, after clipping
  bool box = false;        ///< a point is inside if max |xi_k| < 1, instead of |xi| < 1

  /// Half-widths of the axis-aligned box around the support, m, scaled by `radius`.
  Vec3 half_widths(double radius) const;
};

/// Support from the deformation gradient, its singular values clipped to the inputs' range. A singular or
/// inverted F gives a sphere.
Support make_support(const Mat3& deformation, double spacing, const SupportInputs& inputs);

} // namespace spall
